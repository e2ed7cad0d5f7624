/*
 * A processor that uses the unit and the engine: it sends pairs and queries through their registers, takes their interrupts, decides
 * undecided pairs exactly, and prints all answers on the serial line. Meshes, poses and pairs are in data.h, what a processor has of
 * its own in platform.h, addresses in soc.h; all other headers are those that efsat has generated.
 */
#define EFSAT_RETEST_WORDS 64
#include "data.h"
#include "efsat_engine_pose.h"
#include "efsat_registers.h"
#include "pairs_efsat.h"
#include "pairs_efsat_registers.h"
#include "soc.h"

/* Words of the longest answer. */
#define LONGEST 256

/* What a core has sent, filled by its interrupt. */
struct answer {
  uint8_t bytes[8 * LONGEST];
  volatile size_t size;
  volatile int ended;
};

static struct answer from_pairs, from_queries;
static volatile unsigned interrupts;
static struct efsat_retest_room room;

/* Ends the program with what was refused. */
static void stop(const char *why);

/* Both cores interrupt while a word of an answer waits: what is there is fetched, then the interrupt is cleared, which comes again if
 * more is there. */
static void take_interrupts(int of_pairs, int of_queries);

#include "platform.h"

static void put(const char *text)
{
  for (; *text; text++)
    put_byte((uint8_t)*text);
}

static void put_number(uint64_t number)
{
  char digits[21];
  *efsat_engine_say_number(digits, (int64_t)number, 0) = 0;
  put(digits);
}

static void stop(const char *why)
{
  put("error: ");
  put(why);
  put("\nend\n");
  for (;;)
    ;
}

static void stop_at(const struct efsat_engine_refusal *why)
{
  char text[EFSAT_ENGINE_EXPLANATION];
  stop(efsat_engine_explain(why, text));
}

static void take_interrupts(int of_pairs, int of_queries)
{
  int ended;
  interrupts++;
  if (of_pairs) {
    from_pairs.size += pairs_efsat_registers_receive(PAIRS_BASE, from_pairs.bytes + from_pairs.size, sizeof from_pairs.bytes - from_pairs.size, &ended);
    from_pairs.ended |= ended;
    PAIRS_EFSAT_REGISTERS_WRITE(PAIRS_BASE, PAIRS_EFSAT_REGISTERS_PENDING, PAIRS_EFSAT_REGISTERS_PENDING_RECEIVE_MASK);
  }
  if (of_queries) {
    from_queries.size += efsat_registers_receive(QUERIES_BASE, from_queries.bytes + from_queries.size, sizeof from_queries.bytes - from_queries.size, &ended);
    from_queries.ended |= ended;
    EFSAT_REGISTERS_WRITE(QUERIES_BASE, EFSAT_REGISTERS_PENDING, EFSAT_REGISTERS_PENDING_RECEIVE_MASK);
  }
}

static void put_verdict(unsigned verdict, const double a[9], const double b[9], const double m[9], const double t[3])
{
  static const char *const exactly[] = {"separate", "touch", "intersect"};
  struct efsat_retest_refusal why;
  int answer;
  if (verdict != EFSAT_ENGINE_VERDICT_POSSIBLY_INCORRECT) {
    put(verdict == EFSAT_ENGINE_VERDICT_INTERSECT ? "intersect\n" : "separate\n");
    return;
  }
  if (efsat_retest_posed(&answer, &room, a, b, m, t, &why))
    stop("a retest is refused");
  put("possibly-incorrect, exactly ");
  put(exactly[answer]);
  put("\n");
}

static void test_pairs(void)
{
  static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, zero[3] = {0, 0, 0};
  static uint8_t packet[PAIRS_EFSAT_WORD_BYTES + PAIRS * PAIRS_EFSAT_PAIR_BYTES];
  static struct pairs_efsat_answer answers[PAIRS];
  uint64_t tags[PAIRS];
  struct pairs_efsat_refusal why;
  char text[PAIRS_EFSAT_EXPLANATION];
  size_t sent = 0;
  pairs_efsat_put_header(packet, PAIRS_EFSAT_PAIRS_HEADER);
  for (unsigned i = 0; i < PAIRS; i++) {
    tags[i] = i;
    if (pairs_efsat_put_pair(packet + PAIRS_EFSAT_WORD_BYTES + i * PAIRS_EFSAT_PAIR_BYTES, i, pair_numbers[i], &why))
      stop(pairs_efsat_explain(&why, text));
  }
  while (sent < sizeof packet)
    sent += pairs_efsat_registers_send(PAIRS_BASE, packet + sent, sizeof packet - sent, 1);
  while (!from_pairs.ended)
    ;
  if (pairs_efsat_get_answers(answers, PAIRS, tags, from_pairs.bytes, from_pairs.size, &why))
    stop(pairs_efsat_explain(&why, text));
  for (unsigned i = 0; i < PAIRS; i++) {
    put("pair ");
    put_number(i);
    put(": ");
    put_verdict(answers[i].verdict, pairs[i], pairs[i] + 9, one, zero);
  }
}

/* Reads and checks an image, which stays where the engine reads it, too. */
static void read_image(struct efsat_engine_image *image, const uint8_t *bytes, size_t size)
{
  static uint32_t scratch[EFSAT_ENGINE_SCRATCH_WORDS(MOST_TRIANGLES)];
  struct efsat_engine_refusal why;
  if (efsat_engine_read_image(image, bytes, size, &why) || efsat_engine_check_image(image, scratch, &why))
    stop_at(&why);
}

static void ask_query(const struct efsat_engine_image *const images[2], unsigned number, uint32_t *next)
{
  static struct efsat_engine_query query;
  static uint64_t words[LONGEST];
  uint64_t packet[EFSAT_ENGINE_QUERY_WORDS];
  uint8_t bytes[8 * EFSAT_ENGINE_QUERY_WORDS];
  struct efsat_engine_report report;
  struct efsat_engine_refusal why;
  size_t sent = 0, count;
  for (unsigned i = 0; i < 2; i++)
    query.sides[i] = efsat_engine_image_side(images[i], (uintptr_t)images[i]->bytes);
  if (efsat_engine_put_pose(&query, &room, images, poses[number], poses[number] + 9, &why) || efsat_engine_put_query(packet, &query, next, &why))
    stop_at(&why);
  for (unsigned i = 0; i < sizeof bytes; i++)
    bytes[i] = (uint8_t)(packet[i / 8] >> 8 * (i % 8));
  from_queries.size = 0;
  from_queries.ended = 0;
  while (sent < sizeof bytes)
    sent += efsat_registers_send(QUERIES_BASE, bytes + sent, sizeof bytes - sent, 1);
  while (!from_queries.ended)
    ;
  count = from_queries.size / 8;
  for (size_t i = 0; i < count; i++) {
    words[i] = 0;
    for (unsigned byte = 0; byte < 8; byte++)
      words[i] |= (uint64_t)from_queries.bytes[8 * i + byte] << 8 * byte;
  }
  if (efsat_engine_get_answer(&report, packet, words, count, &why))
    stop_at(&why);
  put("query ");
  put_number(number);
  put(": reason ");
  put_number(report.reason);
  put(", pairs ");
  put_number(count - EFSAT_ENGINE_REPORT_WORDS);
  put("\n");
  for (size_t i = 0; i + EFSAT_ENGINE_REPORT_WORDS < count; i++) {
    const struct efsat_engine_pair pair = efsat_engine_get_pair(words[i]);
    put_number(pair.a);
    put(" ");
    put_number(pair.b);
    put(": ");
    put_verdict(pair.verdict, mesh_a[pair.a], mesh_b[pair.b], poses[number], poses[number] + 9);
  }
}

int main(void)
{
  struct efsat_engine_image images[2];
  const struct efsat_engine_image *const both[2] = {&images[0], &images[1]};
  uint32_t next = 1;
  if (!pairs_efsat_registers_fit(PAIRS_BASE) || !efsat_registers_fit(QUERIES_BASE))
    stop("the cores are not those of the headers");
  PAIRS_EFSAT_REGISTERS_WRITE(PAIRS_BASE, PAIRS_EFSAT_REGISTERS_CONTROL, PAIRS_EFSAT_REGISTERS_CONTROL_ENABLE_MASK);
  EFSAT_REGISTERS_WRITE(QUERIES_BASE, EFSAT_REGISTERS_CONTROL, EFSAT_REGISTERS_CONTROL_ENABLE_MASK);
  PAIRS_EFSAT_REGISTERS_WRITE(PAIRS_BASE, PAIRS_EFSAT_REGISTERS_MASK, PAIRS_EFSAT_REGISTERS_MASK_RECEIVE_MASK);
  EFSAT_REGISTERS_WRITE(QUERIES_BASE, EFSAT_REGISTERS_MASK, EFSAT_REGISTERS_MASK_RECEIVE_MASK);
  enable_interrupts();
  test_pairs();
  read_image(&images[0], image_a, sizeof image_a);
  read_image(&images[1], image_b, sizeof image_b);
  for (unsigned i = 0; i < POSES; i++)
    ask_query(both, i, &next);
  put(interrupts ? "interrupts: some\n" : "interrupts: none\n");
  put("end\n");
  return 0;
}

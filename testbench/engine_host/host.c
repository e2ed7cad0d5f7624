#include "efsat_engine.h"
#include <inttypes.h>
#include <stdio.h>

static long long next(void)
{
  long long number = 0;
  if (scanf("%lld", &number) != 1)
    number = -1;
  return number;
}

static void print(const uint64_t *words, unsigned count)
{
  for (unsigned i = 0; i < count; i++)
    printf("%016" PRIx64 "%s", words[i], i + 1 < count ? " " : "\n");
}

int main(void)
{
  char kind;
  while (scanf(" %c", &kind) == 1) {
    if (kind == 'q') {
      struct efsat_engine_query query;
      uint64_t packet[EFSAT_ENGINE_QUERY_WORDS];
      for (unsigned i = 0; i < 2; i++) {
        query.sides[i].blocks_at = (uint64_t)next() * 64;
        query.sides[i].triangles_at = (uint64_t)next() * 64;
        query.sides[i].blocks = (uint32_t)next();
        query.sides[i].triangles = (uint32_t)next();
      }
      query.options.limit = (uint32_t)next();
      query.options.flags = (uint32_t)next();
      uint32_t number = (uint32_t)next();
      for (unsigned i = 0; i < 3; i++)
        query.errors[i] = (uint32_t)next();
      STICKY;
      for (unsigned i = 0; i < 12; i++)
        query.pose[i] = next();
      for (unsigned i = 0; i < EFSAT_ENGINE_ROWS; i++) {
        for (unsigned slot = 0; slot < 3; slot++) {
          query.rows[i].choice[slot] = (uint32_t)next();
          query.rows[i].factor[slot] = (uint32_t)next();
        }
        query.rows[i].rest = (uint32_t)next();
      }
      char text[EFSAT_ENGINE_EXPLANATION];
      struct efsat_engine_refusal why;
      const uint32_t own = number;
      if (efsat_engine_put_query(packet, &query, &number, &why)) {
        printf("%s\n", efsat_engine_explain(&why, text));
        continue;
      }
      print(packet, EFSAT_ENGINE_QUERY_WORDS);
      if (number != own + 1 || efsat_engine_move(packet, 640, &why))
        return 1;
      print(packet + 1, 2);
      if (!efsat_engine_move(packet, 63, &why) || !efsat_engine_move(packet, -(INT64_C(1) << 39), NULL))
        return 1;
      uint64_t orders[2] = {efsat_engine_stop(0xabcdef), efsat_engine_reset(7)};
      print(orders, 2);
    } else if (kind == 'd') {
      uint64_t packet[EFSAT_ENGINE_QUERY_WORDS] = {0}, words[64];
      packet[EFSAT_ENGINE_TRIANGLES_WORD] = (uint64_t)next();
      packet[EFSAT_ENGINE_OPTIONS_WORD] = (uint64_t)next();
      const size_t count = (size_t)next();
      struct efsat_engine_report report;
      for (size_t i = 0; i < count; i++) {
        uint64_t low = (uint64_t)next();
        words[i] = low | (uint64_t)next() << 32;
      }
      printf("%s\n", efsat_engine_get_answer(&report, packet, words, count, NULL) ? "refused" : "taken");
    } else {
      uint64_t words[EFSAT_ENGINE_REPORT_WORDS];
      struct efsat_engine_pair pair = efsat_engine_get_pair((uint64_t)next());
      printf("%u %" PRIu32 " %" PRIu32 "\n", pair.verdict, pair.a, pair.b);
      for (unsigned i = 0; i < EFSAT_ENGINE_REPORT_WORDS; i++) {
        uint64_t low = (uint64_t)next();
        words[i] = low | (uint64_t)next() << 32;
      }
      struct efsat_engine_report r = efsat_engine_get_report(words);
      printf("%u %u", r.reason, r.incomplete);
      const uint32_t counts[] = {r.number, r.clocks, r.expansions, r.tests, r.survivors, r.leaf_pairs, r.intersect,
        r.possibly_incorrect, r.blocks, r.blocks_read, r.triangles, r.triangles_read, r.words_read, r.memory_waits,
        r.queue_waits, r.stack};
      for (unsigned i = 0; i < sizeof counts / sizeof *counts; i++)
        printf(" %" PRIu32, counts[i]);
      printf("\n");
    }
  }
  return 0;
}

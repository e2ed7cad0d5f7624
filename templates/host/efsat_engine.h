{% for line in header -%}
/* {{ line }} */
{% endfor -%}
/*
 * The words of {{ prefix }}efsat_engine in C99: constants, packing of packets, unpacking of answers. A packet is words of 64 bits,
 * TLAST with the last one; on the wire their bytes are little-endian. Images of trees are made by `efsat tree build`, and the
 * numbers and rows of a pose by `efsat tree query`.
 */
#ifndef {{ upper }}_H
#define {{ upper }}_H

#include <stdint.h>
{% for group in groups %}
/* {{ group.what }} */
{%- for constant in group.constants %}
#define {{ upper }}_{{ constant.upper() }} {{ constant.c() }} /* {{ constant.what }} */
{%- endfor %}
{% endfor %}
/* Where an object is in memory: addresses in bytes, multiples of 64, of its blocks and of its triangles, and how many there are. */
struct {{ prefix }}efsat_engine_side {
  uint64_t blocks_at;
  uint64_t triangles_at;
  uint32_t blocks;
  uint32_t triangles;
};

/* A row of the realignment: three choices of a direction with their factors, and the rest. */
struct {{ prefix }}efsat_engine_row {
  uint32_t choice[3];
  uint32_t factor[3];
  uint32_t rest;
};

/* What is asked for: `flags` is an OR of {{ upper }}_FIRST_CONTACT and the like, `limit` the most expansions or 0, `number` returns
 * in the report, and names the query in a stop. Without {{ upper }}_KEEP_CACHES the engine reads again what the query needs; with it
 * the answer is right only if no image has been written to since the last query without it. */
struct {{ prefix }}efsat_engine_options {
  uint32_t limit;
  uint32_t flags;
  uint32_t number;
};

/* A query: A and B, errors of the shift, the pose m00 m01 m02 m10 ... m22 t_x t_y t_z in units of
 * 2^({{ upper }}_INTEGRAL_BITS - {{ upper }}_TRANSFORM_BITS), a row for each direction.
{%- if is_sticky %} Bit i of `sticky` is set if number i is greater than its lower bound.{% endif %} */
struct {{ prefix }}efsat_engine_query {
  struct {{ prefix }}efsat_engine_side sides[2];
  struct {{ prefix }}efsat_engine_options options;
  uint32_t errors[3];
  int32_t pose[12];
{%- if is_sticky %}
  uint32_t sticky;
{%- endif %}
  struct {{ prefix }}efsat_engine_row rows[{{ upper }}_DIRECTIONS];
};

/* A pair of triangles in an answer: one of {{ upper }}_VERDICT_..., and the faces of A and of B. */
struct {{ prefix }}efsat_engine_pair {
  unsigned verdict;
  uint32_t a;
  uint32_t b;
};

/* The end of an answer. If `incomplete` is set, pairs that touch may be missing: find them in software. */
struct {{ prefix }}efsat_engine_report {
  unsigned reason;
  unsigned incomplete;
  uint32_t number;
  uint32_t clocks;
  uint32_t expansions;
  uint32_t tests;
  uint32_t survivors;
  uint32_t leaf_pairs;
  uint32_t intersect;
  uint32_t possibly_incorrect;
  uint32_t blocks;
  uint32_t blocks_read;
  uint32_t triangles;
  uint32_t triangles_read;
  uint32_t words_read;
  uint32_t memory_waits;
  uint32_t queue_waits;
  uint32_t stack;
};

static inline uint64_t {{ prefix }}efsat_engine_both(uint64_t low, uint64_t high)
{
  return (low & UINT32_MAX) | high << 32;
}

/* The word of a query that says what is asked for, number {{ upper }}_OPTIONS_WORD of the packet. */
static inline uint64_t {{ prefix }}efsat_engine_options_word(struct {{ prefix }}efsat_engine_options options)
{
  return (uint64_t)options.number << {{ upper }}_QUERY_NUMBER_LOW | {{ prefix }}efsat_engine_both(options.limit, options.flags);
}

/* The packet of a query. */
static inline void {{ prefix }}efsat_engine_put_query(uint64_t packet[{{ upper }}_QUERY_WORDS], const struct {{ prefix }}efsat_engine_query *query)
{
  const struct {{ prefix }}efsat_engine_side *a = &query->sides[0], *b = &query->sides[1];
  uint64_t *word = packet;
  *word++ = {{ prefix }}efsat_engine_both({{ upper }}_QUERY_HEADER, {{ upper }}_QUERY_FORMAT);
  *word++ = {{ prefix }}efsat_engine_both(a->blocks_at / 64, b->blocks_at / 64);
  *word++ = {{ prefix }}efsat_engine_both(a->triangles_at / 64, b->triangles_at / 64);
  *word++ = {{ prefix }}efsat_engine_both(a->blocks, b->blocks);
  *word++ = {{ prefix }}efsat_engine_both(a->triangles, b->triangles);
  *word++ = {{ prefix }}efsat_engine_options_word(query->options);
  *word++ = {{ prefix }}efsat_engine_both(query->errors[0] | query->errors[1] << 16, query->errors[2]);
  *word++ = {% if is_sticky %}query->sticky{% else %}0{% endif %};
  for (unsigned i = 0; i < 12; i += 2)
    *word++ = {{ prefix }}efsat_engine_both((uint32_t)query->pose[i], (uint32_t)query->pose[i + 1]);
  for (unsigned i = 0; i < {{ upper }}_DIRECTIONS; i++) {
    const struct {{ prefix }}efsat_engine_row *row = &query->rows[i];
    *word = (uint64_t)row->rest << {{ upper }}_ROW_REST_LOW;
    for (unsigned slot = 0; slot < 3; slot++)
      *word |= ((uint64_t)row->factor[slot] << {{ upper }}_ROW_CHOICE_BITS | row->choice[slot]) << slot * {{ upper }}_ROW_SLOT_BITS;
    word++;
  }
}

/* Moves the images of both objects of a query by so many bytes, a multiple of 64. */
static inline void {{ prefix }}efsat_engine_move(uint64_t packet[{{ upper }}_QUERY_WORDS], int64_t bytes)
{
  const uint64_t lines = (uint64_t)(bytes / 64);
  for (unsigned i = 1; i <= 2; i++)
    packet[i] = {{ prefix }}efsat_engine_both((packet[i] & UINT32_MAX) + lines, (packet[i] >> 32) + lines);
}
{% if block_ram %}
/* The first two words of a packet that fills memory from a byte address on: 0 or more for blocks, {{ upper }}_TRIANGLES_AT or more
 * for triangles. The words of the image follow, eight for each block or triangle. */
static inline void {{ prefix }}efsat_engine_put_load(uint64_t words[2], uint32_t address)
{
  words[0] = {{ upper }}_LOAD_HEADER;
  words[1] = address;
}
{% endif %}
/* The only word of a packet that ends the query with a number, if it runs or waits; it has no answer of its own. */
static inline uint64_t {{ prefix }}efsat_engine_stop(uint32_t number)
{
  return (uint64_t)number << {{ upper }}_QUERY_NUMBER_LOW | {{ upper }}_STOP_HEADER;
}

/* The only word of a packet after which nothing that was sent before has another answer than the report to this: its reason is
 * {{ upper }}_REASON_RESET, its number the given one, and words before it in its packet mean nothing. */
static inline uint64_t {{ prefix }}efsat_engine_reset(uint32_t number)
{
  return (uint64_t)number << {{ upper }}_QUERY_NUMBER_LOW | {{ upper }}_RESET_HEADER;
}

/* A pair; with verdict {{ upper }}_VERDICT_REPORT the word is the first one of the report. */
static inline struct {{ prefix }}efsat_engine_pair {{ prefix }}efsat_engine_get_pair(uint64_t word)
{
  struct {{ prefix }}efsat_engine_pair pair;
  pair.verdict = (unsigned)(word & 3);
  pair.a = (uint32_t)(word >> {{ upper }}_ANSWER_A_LOW & ((UINT32_C(1) << {{ upper }}_ANSWER_NUMBER_BITS) - 1));
  pair.b = (uint32_t)(word >> {{ upper }}_ANSWER_B_LOW & ((UINT32_C(1) << {{ upper }}_ANSWER_NUMBER_BITS) - 1));
  return pair;
}

/* The last {{ upper }}_REPORT_WORDS words of an answer. */
static inline struct {{ prefix }}efsat_engine_report {{ prefix }}efsat_engine_get_report(const uint64_t words[{{ upper }}_REPORT_WORDS])
{
  struct {{ prefix }}efsat_engine_report report;
  report.reason = (unsigned)(words[0] >> {{ upper }}_REPORT_REASON_LOW & 31);
  report.incomplete = (unsigned)(words[0] >> {{ upper }}_REPORT_INCOMPLETE & 1);
  report.number = (uint32_t)words[0] >> {{ upper }}_REPORT_NUMBER_LOW;
  report.clocks = (uint32_t)(words[0] >> 32);
  report.expansions = (uint32_t)words[1];
  report.tests = (uint32_t)(words[1] >> 32);
  report.survivors = (uint32_t)words[2];
  report.leaf_pairs = (uint32_t)(words[2] >> 32);
  report.intersect = (uint32_t)words[3];
  report.possibly_incorrect = (uint32_t)(words[3] >> 32);
  report.blocks = (uint32_t)words[4];
  report.blocks_read = (uint32_t)(words[4] >> 32);
  report.triangles = (uint32_t)words[5];
  report.triangles_read = (uint32_t)(words[5] >> 32);
  report.words_read = (uint32_t)words[6];
  report.memory_waits = (uint32_t)(words[6] >> 32);
  report.queue_waits = (uint32_t)words[7];
  report.stack = (uint32_t)(words[7] >> 32);
  return report;
}

#endif

{% for line in h.header -%}
/* {{ line }} */
{% endfor -%}
/*
 * The words of {{ h.prefix }}efsat_engine in C99 and C++: constants, packing of packets, unpacking of answers. A packet is words of 64
 * bits, TLAST with the last one; on the wire their bytes are little-endian. Images of trees, made by `efsat tree build`, are read in
 * {{ h.file }}_image.h; the numbers of a pose are computed in {{ h.file }}_pose.h; possibly incorrect pairs are decided in
 * {{ h.retest }}.h.
 *
 * A function that returns int refuses what the engine makes no promise for, and answers that it cannot have given: it returns 0, or
 * one of {{ h.upper }}_REFUSED_... and has then written nothing. `why`, if it is not null, gets the details, and
 * {{ h.prefix }}efsat_engine_explain puts them into words.
 */
#ifndef {{ h.upper }}_H
#define {{ h.upper }}_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
{% for group in h.groups %}
/* {{ group.what }} */
{%- for constant in group.constants %}
#define {{ h.upper }}_{{ constant.upper() }} {{ constant.c() }} /* {{ constant.what }} */
{%- endfor %}
{% endfor %}
{% include "host/refusal.h" %}
{% if h.by_number %}{% include "host/numbers_head.h" %}
{% else -%}
/* Where an object is in memory: addresses in bytes, multiples of 64, of its blocks and of its triangles, and how many there are. */
struct {{ h.prefix }}efsat_engine_side {
  uint64_t blocks_at;
  uint64_t triangles_at;
  uint32_t blocks;
  uint32_t triangles;
};

/* A row of the realignment, for two opposite directions: three choices of a direction with their factors, and the rest. */
struct {{ h.prefix }}efsat_engine_row {
  uint32_t choice[3];
  uint32_t factor[3];
  uint32_t rest;
};

/* What is asked for: `flags` is an OR of {{ h.upper }}_FIRST_CONTACT and the like, `limit` the most expansions or 0. Without
 * {{ h.upper }}_KEEP_CACHES the engine reads again what the query needs; with it the answer is right only if no image has been written
 * to since the last query without it. */
struct {{ h.prefix }}efsat_engine_options {
  uint32_t limit;
  uint32_t flags;
};

/* A query: A and B, errors of the shift, the pose m00 m01 m02 m10 ... m22 t_x t_y t_z in units of
 * 2^({{ h.upper }}_INTEGRAL_BITS - {{ h.upper }}_TRANSFORM_BITS), a row for each two opposite directions.
{%- if h.is_sticky %} Bit i of `sticky` is set if number i is greater than its lower bound.{% endif %} */
struct {{ h.prefix }}efsat_engine_query {
  struct {{ h.prefix }}efsat_engine_side sides[2];
  struct {{ h.prefix }}efsat_engine_options options;
  uint32_t errors[3];
  int64_t pose[12];
{%- if h.is_sticky %}
  uint32_t sticky;
{%- endif %}
  struct {{ h.prefix }}efsat_engine_row rows[{{ h.upper }}_ROWS];
};

{% endif -%}
/* A pair of triangles in an answer: one of {{ h.upper }}_VERDICT_..., and the faces of A and of B. */
struct {{ h.prefix }}efsat_engine_pair {
  unsigned verdict;
  uint32_t a;
  uint32_t b;
};

/* The end of an answer. If `incomplete` is set, pairs that touch may be missing: find them in software. */
struct {{ h.prefix }}efsat_engine_report {
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

static inline uint64_t {{ h.prefix }}efsat_engine_both(uint64_t low, uint64_t high)
{
  return (low & UINT32_MAX) | high << 32;
}

/* Whether the numbers of a pose are inside the declared ranges. */
static inline int {{ h.prefix }}efsat_engine_check_pose(const int64_t pose[12]{% if h.is_sticky %}, uint32_t sticky{% endif %}, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  int refused = 0;
  for (unsigned i = 0; i < 12 && !refused; i++) {
    const int64_t above = {% if h.is_sticky %}sticky >> i & 1{% else %}0{% endif %};
    refused = i < 9 ? {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_ENTRY, i, pose[i], {{ h.upper }}_ENTRY_LEAST, {{ h.upper }}_ENTRY_MOST - above)
                    : {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_TRANSLATION, i, pose[i], {{ h.upper }}_TRANSLATION_LEAST, {{ h.upper }}_TRANSLATION_MOST - above);
  }
{%- if h.is_sticky %}
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_STICKY, {{ h.upper }}_NO_INDEX, sticky, 0, 4095);
{%- endif %}
  return refused;
}

{% if h.by_number %}{% include "host/numbers_put.h" %}
{% else -%}
/* Asks in a packet of a query for something else. The query gets the number `*next`, which then is the next one, so that no two of the
 * last 2^{{ h.upper }}_QUERY_NUMBER_BITS queries have the same; begin with any. The report of its answer has to return it. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_ask(uint64_t packet[{{ h.upper }}_QUERY_WORDS], struct {{ h.prefix }}efsat_engine_options options, uint32_t *next,
    struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const uint32_t known = {{ h.upper }}_QUERY_FLAGS;
  if (options.flags & ~known)
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_FLAGS, {{ h.upper }}_NO_INDEX, options.flags, 0, known);
  *next &= (UINT32_C(1) << {{ h.upper }}_QUERY_NUMBER_BITS) - 1;
  packet[{{ h.upper }}_OPTIONS_WORD] = (uint64_t)*next << {{ h.upper }}_QUERY_NUMBER_LOW | {{ h.prefix }}efsat_engine_both(options.limit, options.flags);
  ++*next;
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}

/* Whether all fields of a query are inside their ranges, and the numbers of its pose inside the declared ones. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_check_query(const struct {{ h.prefix }}efsat_engine_query *query, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  static const uint32_t choices[3] = { {{ h.slots }} };
  int refused = 0;
  for (unsigned i = 0; i < 4 && !refused; i++) {
    const struct {{ h.prefix }}efsat_engine_side *side = &query->sides[i / 2];
    const uint64_t address = i % 2 ? side->triangles_at : side->blocks_at;
    if (address % 64 || address >> 38)
      refused = {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_ADDRESS, i, (int64_t)address, 0, (INT64_C(1) << 38) - 64);
  }
  for (unsigned i = 0; i < 3 && !refused; i++)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_ERROR, i, query->errors[i], 0, 65535);
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_check_pose(query->pose{% if h.is_sticky %}, query->sticky{% endif %}, why);
  for (unsigned i = 0; i < {{ h.upper }}_ROWS && !refused; i++) {
    const struct {{ h.prefix }}efsat_engine_row *row = &query->rows[i];
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_REST, i, row->rest, 0, (INT64_C(1) << {{ h.upper }}_ROW_REST_BITS) - 1);
    for (unsigned slot = 0; slot < 3 && !refused; slot++) {
      refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_CHOICE, i, row->choice[slot], 0, choices[slot] - 1);
      if (!refused)
        refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_FACTOR, i, row->factor[slot], 0, (INT64_C(1) << {{ h.upper }}_FACTOR_BITS) - 1);
    }
  }
  return refused;
}

/* The packet of a query, with the number `*next` as `{{ h.prefix }}efsat_engine_ask` gives it. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_put_query(uint64_t packet[{{ h.upper }}_QUERY_WORDS], const struct {{ h.prefix }}efsat_engine_query *query,
    uint32_t *next, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const struct {{ h.prefix }}efsat_engine_side *a = &query->sides[0], *b = &query->sides[1];
  uint64_t *word = packet;
  int refused = {{ h.prefix }}efsat_engine_check_query(query, why);
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_ask(packet, query->options, next, why);
  if (refused)
    return refused;
  *word++ = {{ h.prefix }}efsat_engine_both({{ h.upper }}_QUERY_HEADER, {{ h.upper }}_QUERY_FORMAT);
  *word++ = {{ h.prefix }}efsat_engine_both(a->blocks_at / 64, b->blocks_at / 64);
  *word++ = {{ h.prefix }}efsat_engine_both(a->triangles_at / 64, b->triangles_at / 64);
  *word++ = {{ h.prefix }}efsat_engine_both(a->blocks, b->blocks);
  *word++ = {{ h.prefix }}efsat_engine_both(a->triangles, b->triangles);
  word++;
  *word++ = {{ h.prefix }}efsat_engine_both(query->errors[0] | query->errors[1] << 16, query->errors[2]);
  *word++ = {% if h.is_sticky %}query->sticky{% else %}0{% endif %};
  for (unsigned i = 0; i < 12; i += 2)
    *word++ = {{ h.prefix }}efsat_engine_both((uint64_t)query->pose[i], (uint64_t)query->pose[i + 1]);
  for (unsigned i = 0; i < {{ h.upper }}_ROWS; i++) {
    const struct {{ h.prefix }}efsat_engine_row *row = &query->rows[i];
    *word = (uint64_t)row->rest << {{ h.upper }}_ROW_REST_LOW;
    for (unsigned slot = 0; slot < 3; slot++)
      *word |= ((uint64_t)row->factor[slot] << {{ h.upper }}_ROW_CHOICE_BITS | row->choice[slot]) << slot * {{ h.upper }}_ROW_SLOT_BITS;
    word++;
  }
  return 0;
}

/* Moves the images of both objects of a query by so many bytes, a multiple of 64. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_move(uint64_t packet[{{ h.upper }}_QUERY_WORDS], int64_t bytes,
    struct {{ h.prefix }}efsat_engine_refusal *why)
{
  int64_t lines[4];
  for (unsigned i = 0; i < 4; i++) {
    lines[i] = (int64_t)(packet[1 + i / 2] >> (32 * (i % 2)) & UINT32_MAX) + bytes / 64;
    if (bytes % 64 || lines[i] < 0 || lines[i] > (int64_t)UINT32_MAX)
      return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_MOVE, {{ h.upper }}_NO_INDEX, bytes, 0, 0);
  }
  for (unsigned i = 0; i < 2; i++)
    packet[1 + i] = {{ h.prefix }}efsat_engine_both((uint64_t)lines[2 * i], (uint64_t)lines[2 * i + 1]);
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}
{% endif -%}
{% if h.block_ram %}
/* The first two words of a packet that fills memory from a byte address on: 0 or more for blocks, {{ h.upper }}_TRIANGLES_AT or more
 * for triangles. The words of the image follow, eight for each block or triangle. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_put_load(uint64_t words[2], uint64_t address, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  if (address % 64 || address >> 32)
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_ADDRESS, {{ h.upper }}_NO_INDEX, (int64_t)address, 0, (INT64_C(1) << 32) - 64);
  words[0] = {{ h.upper }}_LOAD_HEADER;
  words[1] = address;
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}
{% endif %}
{% if !h.by_number -%}
/* The only word of a packet that ends the query with a number (its lower {{ h.upper }}_QUERY_NUMBER_BITS bits count), if it runs or
 * waits; it has no answer of its own. */
static inline uint64_t {{ h.prefix }}efsat_engine_stop(uint32_t number)
{
  return (uint64_t)number << {{ h.upper }}_QUERY_NUMBER_LOW | {{ h.upper }}_STOP_HEADER;
}

{% endif -%}
/* The only word of a packet after which nothing that was sent before has another answer than the report to this: its reason is
 * {{ h.upper }}_REASON_RESET, its number the given one, and words before it in its packet mean nothing. */
static inline uint64_t {{ h.prefix }}efsat_engine_reset(uint32_t number)
{
  return (uint64_t)number << {{ h.upper }}_QUERY_NUMBER_LOW | {{ h.upper }}_RESET_HEADER;
}

/* A pair; with verdict {{ h.upper }}_VERDICT_REPORT the word is the first one of the report. */
static inline struct {{ h.prefix }}efsat_engine_pair {{ h.prefix }}efsat_engine_get_pair(uint64_t word)
{
  struct {{ h.prefix }}efsat_engine_pair pair;
  pair.verdict = (unsigned)(word & 3);
  pair.a = (uint32_t)(word >> {{ h.upper }}_ANSWER_A_LOW & ((UINT32_C(1) << {{ h.upper }}_ANSWER_NUMBER_BITS) - 1));
  pair.b = (uint32_t)(word >> {{ h.upper }}_ANSWER_B_LOW & ((UINT32_C(1) << {{ h.upper }}_ANSWER_NUMBER_BITS) - 1));
  return pair;
}

/* The last {{ h.upper }}_REPORT_WORDS words of an answer. */
static inline struct {{ h.prefix }}efsat_engine_report {{ h.prefix }}efsat_engine_get_report(const uint64_t words[{{ h.upper }}_REPORT_WORDS])
{
  struct {{ h.prefix }}efsat_engine_report report;
  report.reason = (unsigned)(words[0] >> {{ h.upper }}_REPORT_REASON_LOW & 31);
  report.incomplete = (unsigned)(words[0] >> {{ h.upper }}_REPORT_INCOMPLETE & 1);
  report.number = (uint32_t)words[0] >> {{ h.upper }}_REPORT_NUMBER_LOW;
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

/* Whether pairs that intersect, and those possibly incorrect, are as many as a report counts. */
static inline int {{ h.prefix }}efsat_engine_check_counts(const int64_t found[3], const struct {{ h.prefix }}efsat_engine_report *report, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const int refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_COUNT, {{ h.upper }}_NO_INDEX, found[{{ h.upper }}_VERDICT_INTERSECT], report->intersect, report->intersect);
  return refused ? refused : {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_COUNT, {{ h.upper }}_NO_INDEX, found[{{ h.upper }}_VERDICT_POSSIBLY_INCORRECT],
      report->possibly_incorrect, report->possibly_incorrect);
}

{% if h.by_number %}{% include "host/numbers_get.h" %}
{% else -%}
static inline int {{ h.prefix }}efsat_engine_by_triangles(const void *one, const void *other)
{
  const uint64_t a = *(const uint64_t *)one >> 8, b = *(const uint64_t *)other >> 8;
  return (a > b) - (a < b);
}

/* All words of the answer to a query: pairs, which are sorted in place, and the report, which is copied. Refuses an answer that is not
 * that of this packet, or that the engine cannot have given: a report of another query, words that are no pairs of its objects, a pair
 * twice, other pairs than the report counts. Of an incomplete answer the pairs are not looked at: they prove nothing. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_get_answer(struct {{ h.prefix }}efsat_engine_report *report, const uint64_t packet[{{ h.upper }}_QUERY_WORDS],
    uint64_t *words, size_t count, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const uint64_t options = packet[{{ h.upper }}_OPTIONS_WORD], counts = packet[{{ h.upper }}_TRIANGLES_WORD];
  const uint64_t number = options >> {{ h.upper }}_QUERY_NUMBER_LOW & ((UINT64_C(1) << {{ h.upper }}_QUERY_NUMBER_BITS) - 1);
  const uint32_t flags = (uint32_t)(options >> 32);
  const size_t pairs = count < {{ h.upper }}_REPORT_WORDS ? 0 : count - {{ h.upper }}_REPORT_WORDS;
  const uint64_t *last = words + pairs;
  int64_t found[3] = {0, 0, 0};
  if (count < {{ h.upper }}_REPORT_WORDS || (last[0] & 3) != {{ h.upper }}_VERDICT_REPORT)
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_NO_REPORT, {{ h.upper }}_NO_INDEX, (int64_t)count, 0, 0);
  *report = {{ h.prefix }}efsat_engine_get_report(last);
  if (report->reason > {{ h.upper }}_REASON_RESET || report->incomplete != (report->reason >= {{ h.upper }}_REASON_LIMIT) || report->stack > 65535)
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_NO_REPORT, {{ h.upper }}_NO_INDEX, (int64_t)count, 0, 0);
  /* The report of a packet that was not read has no number, that of a soft reset one of its own. */
  if (report->number != number && (report->reason < {{ h.upper }}_REASON_UNKNOWN_HEADER || report->reason == {{ h.upper }}_REASON_SILENT))
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_ANSWER_NUMBER, {{ h.upper }}_NO_INDEX, report->number, (int64_t)number, (int64_t)number);
  if (report->incomplete)
    return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
  for (size_t i = 0; i < pairs; i++) {
    const struct {{ h.prefix }}efsat_engine_pair pair = {{ h.prefix }}efsat_engine_get_pair(words[i]);
    if (words[i] >> 2 & 63 || pair.verdict == {{ h.upper }}_VERDICT_REPORT || pair.a >= (counts & UINT32_MAX) || pair.b >= counts >> 32
        || (pair.verdict == {{ h.upper }}_VERDICT_SEPARATE && !(flags & {{ h.upper }}_ALL_PAIRS))
        || (pair.verdict != {{ h.upper }}_VERDICT_POSSIBLY_INCORRECT && flags & {{ h.upper }}_LEAF_PAIRS))
      return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_PAIR, (uint32_t)i, (int64_t)words[i], 0, 0);
    found[pair.verdict]++;
  }
  if ({{ h.prefix }}efsat_engine_check_counts(found, report, why))
    return {{ h.upper }}_REFUSED_COUNT;
  /* All pairs are answered if all were asked for, or if no triangle is tested. */
  if (flags & ({{ h.upper }}_ALL_PAIRS | {{ h.upper }}_LEAF_PAIRS) && report->reason == {{ h.upper }}_REASON_COMPLETE && pairs != report->leaf_pairs)
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_COUNT, {{ h.upper }}_NO_INDEX, (int64_t)pairs, report->leaf_pairs, report->leaf_pairs);
  /* A contact ends a query only if one was asked for, and is among the pairs. */
  if (report->reason == {{ h.upper }}_REASON_CONTACT && (!(flags & {{ h.upper }}_FIRST_CONTACT) || !report->intersect))
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_NO_REPORT, {{ h.upper }}_NO_INDEX, (int64_t)count, 0, 0);
  qsort(words, pairs, sizeof *words, {{ h.prefix }}efsat_engine_by_triangles);
  for (size_t i = 1; i < pairs; i++)
    if (words[i - 1] >> 8 == words[i] >> 8)
      return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_TWICE, (uint32_t)i, (int64_t)words[i], 0, 0);
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}

{% endif -%}
#endif

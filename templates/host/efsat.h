{% for line in header -%}
/* {{ line }} */
{% endfor -%}
/*
 * The words of {{ prefix }}efsat_stream in C99: constants, packing of records, unpacking of answers. A packet in is a header word
 * and then records, TLAST with the last word; a packet out is one answer for each pair, or one report. All bytes are
 * little-endian, whatever the machine is.
 */
#ifndef {{ upper }}_H
#define {{ upper }}_H

#include <stdint.h>
#include <string.h>
{% for group in groups %}
/* {{ group.what }} */
{%- for constant in group.constants %}
#define {{ upper }}_{{ constant.upper() }} {{ constant.c() }} /* {{ constant.what }} */
{%- endfor %}
{% endfor %}
/* Bytes of a word in, of records and of an answer. */
#define {{ upper }}_WORD_BYTES ({{ upper }}_WORD_BITS / 8)
#define {{ upper }}_PAIR_BYTES ({{ upper }}_PAIR_WORDS * {{ upper }}_WORD_BYTES)
{%- if has_pose %}
#define {{ upper }}_POSE_BYTES ({{ upper }}_POSE_WORDS * {{ upper }}_WORD_BYTES)
{%- endif %}
#define {{ upper }}_ANSWER_BYTES ({{ upper }}_ANSWER_WORD_BITS / 8)

/* An answer. With verdict {{ upper }}_VERDICT_REPORT it is a report: `reason` says why, 0 pose taken, 1 unknown header, 2 packet too
 * short, 3 packet too long; `malformed` says that no answer of its packet counts. */
struct {{ prefix }}efsat_answer {
  unsigned verdict;
  unsigned reason;
  unsigned outside;
  unsigned malformed;
  uint64_t tag;
  uint32_t separated;
  uint32_t overlapping;
};

/* Whole bytes of a value. */
static inline void {{ prefix }}efsat_put(uint8_t *bytes, unsigned bit, unsigned bits, uint64_t value)
{
  for (unsigned i = 0; i < bits / 8; i++)
    bytes[bit / 8 + i] = (uint8_t)(value >> (8 * i));
}

/* Any bits. */
static inline uint64_t {{ prefix }}efsat_get(const uint8_t *bytes, unsigned bit, unsigned bits)
{
  uint64_t value = 0;
  for (unsigned i = 0; i < bits; i++)
    value |= (uint64_t)(bytes[(bit + i) / 8] >> (bit + i) % 8 & 1) << i;
  return value;
}

/* The first word of a packet; `header` is {{ upper }}_PAIRS_HEADER{% if has_pose %} or {{ upper }}_POSE_HEADER{% endif %}. */
static inline void {{ prefix }}efsat_put_header(uint8_t word[{{ upper }}_WORD_BYTES], uint32_t header)
{
  memset(word, 0, {{ upper }}_WORD_BYTES);
  {{ prefix }}efsat_put(word, 0, 32, header);
}

/* The record of a pair: v0_x v0_y v0_z v1_x ... w2_z, lower bounds in units of 2^({{ upper }}_INTEGRAL_BITS - {{ upper }}_NUMBER_BITS).
{%- if is_sticky %} Bit i of `sticky` is set if number i is greater than its lower bound.{% endif %} */
static inline void {{ prefix }}efsat_put_pair(uint8_t record[{{ upper }}_PAIR_BYTES]{% if has_tag %}, uint64_t tag{% endif %}{% if is_sticky %}, uint32_t sticky{% endif %},
    const int64_t numbers[{{ upper }}_PAIR_NUMBERS])
{
  memset(record, 0, {{ upper }}_PAIR_BYTES);
{%- if is_sticky %}
  {{ prefix }}efsat_put(record, 0, 32, sticky);
{%- endif %}
{%- if has_tag %}
  {{ prefix }}efsat_put(record, {{ upper }}_RECORD_TAG_LOW, {{ upper }}_TAG_BITS > 32 ? 64 : 32, tag);
{%- endif %}
  for (unsigned i = 0; i < {{ upper }}_PAIR_NUMBERS; i++)
    {{ prefix }}efsat_put(record, {{ upper }}_RECORD_NUMBER_LOW + i * {{ upper }}_RECORD_NUMBER_STEP, {{ upper }}_RECORD_NUMBER_STEP,
        (uint64_t)numbers[i]);
}
{% if has_pose %}
/* The record of a pose: {% if has_matrix %}m00 m01 m02 m10 ... m22 {% endif %}t_x t_y t_z. With `bypass` B stays as it is, and the numbers are not read. */
static inline void {{ prefix }}efsat_put_pose(uint8_t record[{{ upper }}_POSE_BYTES], int bypass{% if is_sticky %}, uint32_t sticky{% endif %},
    const int64_t numbers[{{ upper }}_POSE_NUMBERS])
{
  memset(record, 0, {{ upper }}_POSE_BYTES);
  {{ prefix }}efsat_put(record, 0, 32, {% if is_sticky %}sticky | {% endif %}(uint32_t)(bypass != 0) << {{ upper }}_RECORD_BYPASS);
  for (unsigned i = 0; i < {{ upper }}_POSE_NUMBERS; i++)
    {{ prefix }}efsat_put(record, {{ upper }}_RECORD_NUMBER_LOW + i * {{ upper }}_RECORD_NUMBER_STEP, {{ upper }}_RECORD_NUMBER_STEP,
        (uint64_t)numbers[i]);
}
{% endif %}
static inline struct {{ prefix }}efsat_answer {{ prefix }}efsat_get_answer(const uint8_t word[{{ upper }}_ANSWER_BYTES])
{
  struct {{ prefix }}efsat_answer answer = {0};
  answer.verdict = (unsigned){{ prefix }}efsat_get(word, {{ upper }}_ANSWER_VERDICT_LOW, 2);
  answer.reason = (unsigned){{ prefix }}efsat_get(word, {{ upper }}_ANSWER_REASON_LOW, 2);
{%- if has_outside %}
  answer.outside = (unsigned){{ prefix }}efsat_get(word, {{ upper }}_ANSWER_OUTSIDE, 1);
{%- endif %}
  answer.malformed = (unsigned){{ prefix }}efsat_get(word, {{ upper }}_ANSWER_MALFORMED, 1);
{%- if has_tag %}
  answer.tag = {{ prefix }}efsat_get(word, {{ upper }}_ANSWER_TAG_LOW, {{ upper }}_TAG_BITS);
{%- endif %}
  answer.separated = (uint32_t){{ prefix }}efsat_get(word, {{ upper }}_ANSWER_SEPARATED_LOW, {{ upper }}_FLAG_BITS);
  answer.overlapping = (uint32_t){{ prefix }}efsat_get(word, {{ upper }}_ANSWER_OVERLAPPING_LOW, {{ upper }}_FLAG_BITS);
  return answer;
}

#endif

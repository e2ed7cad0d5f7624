{% for line in h.header -%}
/* {{ line }} */
{% endfor -%}
/*
 * The words of {{ h.prefix }}efsat_stream in C99 and C++: constants, packing of records, unpacking of answers. A packet in is a header
 * word and then records, TLAST with the last word; a packet out is one answer for each pair, or one report. All bytes are
 * little-endian, whatever the machine is.
 *
 * A function that returns int refuses what the unit makes no promise for, and answers that it cannot have given: it returns 0, or
 * one of {{ h.upper }}_REFUSED_... and has then written nothing that may be sent or used. `why`, if it is not null, gets the details,
 * and {{ h.prefix }}efsat_explain puts them into words.
 */
#ifndef {{ h.upper }}_H
#define {{ h.upper }}_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>
{% for group in h.groups %}
/* {{ group.what }} */
{%- for constant in group.constants %}
#define {{ h.upper }}_{{ constant.upper() }} {{ constant.c() }} /* {{ constant.what }} */
{%- endfor %}
{% endfor %}
/* Bytes of a word in, of records and of an answer. */
#define {{ h.upper }}_WORD_BYTES ({{ h.upper }}_WORD_BITS / 8)
#define {{ h.upper }}_PAIR_BYTES ({{ h.upper }}_PAIR_WORDS * {{ h.upper }}_WORD_BYTES)
{%- if h.has_pose %}
#define {{ h.upper }}_POSE_BYTES ({{ h.upper }}_POSE_WORDS * {{ h.upper }}_WORD_BYTES)
{%- endif %}
#define {{ h.upper }}_ANSWER_BYTES ({{ h.upper }}_ANSWER_WORD_BITS / 8)

{% include "host/refusal.h" %}
/* An answer. With verdict {{ h.upper }}_VERDICT_REPORT it is a report: `reason` says why, 0 pose taken, 1 unknown header, 2 packet too
 * short, 3 packet too long; `malformed` says that no answer of its packet counts. */
struct {{ h.prefix }}efsat_answer {
  unsigned verdict;
  unsigned reason;
  unsigned outside;
  unsigned malformed;
  uint64_t tag;
  uint32_t separated;
  uint32_t overlapping;
};

/* Whole bytes of a value. */
static inline void {{ h.prefix }}efsat_put(uint8_t *bytes, unsigned bit, unsigned bits, uint64_t value)
{
  for (unsigned i = 0; i < bits / 8; i++)
    bytes[bit / 8 + i] = (uint8_t)(value >> (8 * i));
}

/* Any bits. */
static inline uint64_t {{ h.prefix }}efsat_get(const uint8_t *bytes, unsigned bit, unsigned bits)
{
  uint64_t value = 0;
  for (unsigned i = 0; i < bits; i++)
    value |= (uint64_t)(bytes[(bit + i) / 8] >> (bit + i) % 8 & 1) << i;
  return value;
}

/* The first word of a packet; `header` is {{ h.upper }}_PAIRS_HEADER{% if h.has_pose %} or {{ h.upper }}_POSE_HEADER{% endif %}. */
static inline void {{ h.prefix }}efsat_put_header(uint8_t word[{{ h.upper }}_WORD_BYTES], uint32_t header)
{
  memset(word, 0, {{ h.upper }}_WORD_BYTES);
  {{ h.prefix }}efsat_put(word, 0, 32, header);
}

/* Whether some numbers of one kind are inside their range{% if h.is_sticky %}; one with a sticky bit is above its lower bound, and thus below the end{% endif %}. */
static inline int {{ h.prefix }}efsat_check(int code, uint32_t from, uint32_t to, int64_t least, int64_t most{% if h.is_sticky %}, uint32_t sticky{% endif %},
    const int64_t *numbers, struct {{ h.prefix }}efsat_refusal *why)
{
  for (uint32_t i = from; i < to; i++) {
    const int refused = {{ h.prefix }}efsat_range(why, code, i, numbers[i], least, most{% if h.is_sticky %} - (int64_t)(sticky >> i & 1){% endif %});
    if (refused)
      return refused;
  }
  return {{ h.prefix }}efsat_refuse(why, 0, 0, 0, 0, 0);
}

/* Whether numbers fit their words, which is all that is asked of those that the unit does not read{% if h.has_guards %}, or that its guard checks{% endif %}. */
static inline int {{ h.prefix }}efsat_check_words(uint32_t count, const int64_t *numbers, struct {{ h.prefix }}efsat_refusal *why)
{
  return {{ h.prefix }}efsat_check({{ h.upper }}_REFUSED_NUMBER, 0, count, {{ h.upper }}_NUMBER_LEAST, {{ h.upper }}_NUMBER_MOST{% if h.is_sticky %}, 0{% endif %}, numbers, why);
}

/* Whether the coordinates of a pair are inside the declared range. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_check_pair({% if h.is_sticky %}uint32_t sticky, {% endif %}const int64_t numbers[{{ h.upper }}_PAIR_NUMBERS],
    struct {{ h.prefix }}efsat_refusal *why)
{
  return {{ h.prefix }}efsat_check({{ h.upper }}_REFUSED_COORDINATE, 0, {{ h.upper }}_PAIR_NUMBERS, {{ h.upper }}_COORDINATE_LEAST, {{ h.upper }}_COORDINATE_MOST{% if h.is_sticky %}, sticky{% endif %},
      numbers, why);
}
{% if h.has_pose %}
/* Whether the numbers of a pose are inside the declared ranges; with `bypass` they only have to fit their words. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_check_pose(int bypass{% if h.is_sticky %}, uint32_t sticky{% endif %}, const int64_t numbers[{{ h.upper }}_POSE_NUMBERS],
    struct {{ h.prefix }}efsat_refusal *why)
{
  if (bypass)
    return {{ h.prefix }}efsat_check_words({{ h.upper }}_POSE_NUMBERS, numbers, why);
{%- if h.has_matrix %}
  const int refused = {{ h.prefix }}efsat_check({{ h.upper }}_REFUSED_ENTRY, 0, {{ h.upper }}_POSE_NUMBERS - 3, {{ h.upper }}_ENTRY_LEAST, {{ h.upper }}_ENTRY_MOST{% if h.is_sticky %}, sticky{% endif %},
      numbers, why);
  if (refused)
    return refused;
{%- endif %}
  return {{ h.prefix }}efsat_check({{ h.upper }}_REFUSED_TRANSLATION, {{ h.upper }}_POSE_NUMBERS - 3, {{ h.upper }}_POSE_NUMBERS, {{ h.upper }}_TRANSLATION_LEAST,
      {{ h.upper }}_TRANSLATION_MOST{% if h.is_sticky %}, sticky{% endif %}, numbers, why);
}
{% endif %}
{%- if h.is_sticky %}
/* Whether there is a number for every sticky bit. */
static inline int {{ h.prefix }}efsat_check_sticky(unsigned count, uint32_t sticky, struct {{ h.prefix }}efsat_refusal *why)
{
  return {{ h.prefix }}efsat_range(why, {{ h.upper }}_REFUSED_STICKY, {{ h.upper }}_NO_INDEX, sticky, 0, ((int64_t)1 << count) - 1);
}
{% endif %}
{%- if h.has_tag %}
/* Whether a tag fits its bits. */
static inline int {{ h.prefix }}efsat_check_tag(uint64_t tag, struct {{ h.prefix }}efsat_refusal *why)
{
  const uint64_t most = ~UINT64_C(0) >> (64 - {{ h.upper }}_TAG_BITS);
  return {{ h.prefix }}efsat_refuse(why, tag <= most ? 0 : {{ h.upper }}_REFUSED_TAG, {{ h.upper }}_NO_INDEX, (int64_t)tag, 0, (int64_t)most);
}
{% endif %}
/* A record as it is, of numbers that fit their words. */
static inline void {{ h.prefix }}efsat_put_record(uint8_t *record, unsigned bytes, uint32_t flags{% if h.has_tag %}, uint64_t tag{% endif %}, unsigned count,
    const int64_t *numbers)
{
  memset(record, 0, bytes);
  {{ h.prefix }}efsat_put(record, 0, 32, flags);
{%- if h.has_tag %}
  {{ h.prefix }}efsat_put(record, {{ h.upper }}_RECORD_TAG_LOW, {{ h.upper }}_TAG_BITS > 32 ? 64 : 32, tag);
{%- endif %}
  for (unsigned i = 0; i < count; i++)
    {{ h.prefix }}efsat_put(record, {{ h.upper }}_RECORD_NUMBER_LOW + i * {{ h.upper }}_RECORD_NUMBER_STEP, {{ h.upper }}_RECORD_NUMBER_STEP,
        (uint64_t)numbers[i]);
}

/* The record of a pair: v0_x v0_y v0_z v1_x ... w2_z, lower bounds in units of 2^({{ h.upper }}_INTEGRAL_BITS - {{ h.upper }}_NUMBER_BITS).
{%- if h.is_sticky %} Bit i of `sticky` is set if number i is greater than its lower bound.{% endif %} Refuses a coordinate outside its declared range. */
{%- for all in h.variants %}
{%- if *all %}
/* The same for any number that its word holds: the guard answers possibly incorrect for one outside the declared range. */
{%- endif %}
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_put_{% if *all %}any_{% endif %}pair(uint8_t record[{{ h.upper }}_PAIR_BYTES]{% if h.has_tag %}, uint64_t tag{% endif %}{% if h.is_sticky %}, uint32_t sticky{% endif %},
    const int64_t numbers[{{ h.upper }}_PAIR_NUMBERS], struct {{ h.prefix }}efsat_refusal *why)
{
  int refused = {% if *all %}{{ h.prefix }}efsat_check_words({{ h.upper }}_PAIR_NUMBERS, numbers, why){% else %}{{ h.prefix }}efsat_check_pair({% if h.is_sticky %}sticky, {% endif %}numbers, why){% endif %};
{%- if h.is_sticky %}
  if (!refused)
    refused = {{ h.prefix }}efsat_check_sticky({{ h.upper }}_PAIR_NUMBERS, sticky, why);
{%- endif %}
{%- if h.has_tag %}
  if (!refused)
    refused = {{ h.prefix }}efsat_check_tag(tag, why);
{%- endif %}
  if (!refused)
    {{ h.prefix }}efsat_put_record(record, {{ h.upper }}_PAIR_BYTES, {% if h.is_sticky %}sticky{% else %}0{% endif %}{% if h.has_tag %}, tag{% endif %}, {{ h.upper }}_PAIR_NUMBERS, numbers);
  return refused;
}
{% endfor %}
{%- if h.has_pose %}
/* The record of a pose: {% if h.has_matrix %}m00 m01 m02 m10 ... m22 {% endif %}t_x t_y t_z. With `bypass` B stays as it is, and the numbers are not read. Refuses a number
 * outside its declared range. */
{%- for all in h.variants %}
{%- if *all %}
/* The same for any number that its word holds. */
{%- endif %}
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_put_{% if *all %}any_{% endif %}pose(uint8_t record[{{ h.upper }}_POSE_BYTES], int bypass{% if h.is_sticky %}, uint32_t sticky{% endif %},
    const int64_t numbers[{{ h.upper }}_POSE_NUMBERS], struct {{ h.prefix }}efsat_refusal *why)
{
  int refused = {% if *all %}{{ h.prefix }}efsat_check_words({{ h.upper }}_POSE_NUMBERS, numbers, why){% else %}{{ h.prefix }}efsat_check_pose(bypass{% if h.is_sticky %}, sticky{% endif %}, numbers, why){% endif %};
{%- if h.is_sticky %}
  if (!refused)
    refused = {{ h.prefix }}efsat_check_sticky({{ h.upper }}_POSE_NUMBERS, sticky, why);
{%- endif %}
  if (!refused)
    {{ h.prefix }}efsat_put_record(record, {{ h.upper }}_POSE_BYTES, {% if h.is_sticky %}sticky | {% endif %}(uint32_t)(bypass != 0) << {{ h.upper }}_RECORD_BYPASS{% if h.has_tag %}, 0{% endif %},
        {{ h.upper }}_POSE_NUMBERS, numbers);
  return refused;
}
{% endfor %}
{%- endif %}
/* Whether an answer contradicts itself: a verdict and the flags that it does not follow from, or flags that exclude each other. */
static inline int {{ h.prefix }}efsat_contradicts(const struct {{ h.prefix }}efsat_answer *answer)
{
  const uint32_t s = answer->separated, o = answer->overlapping;
  const int separate = answer->verdict == {{ h.upper }}_VERDICT_SEPARATE, intersect = answer->verdict == {{ h.upper }}_VERDICT_INTERSECT;
  if (answer->verdict == {{ h.upper }}_VERDICT_REPORT)
    return answer->tag || s || o || answer->outside || answer->malformed != (answer->reason != 0);
  if (answer->reason || answer->malformed)
    return 1;
  if (answer->outside)
    return separate || intersect || s || o;
  if (s & o)
    return 1;
{%- if h.method == "axes" %}
  /* An axis that separates decides; else all of the eleven have to overlap{% if h.edge_test %}, or an edge passes through, of which no flag tells{% endif %}. */
  if (separate != (s != 0))
    return 1;
  if ((o & UINT32_C(0x7ff)) == UINT32_C(0x7ff))
    return !intersect;
  return {% if h.edge_test %}0{% else %}intersect{% endif %};
{%- else %}
  /* All of a triangle on one side of the other's plane: its three edges miss the other. */
  if ((s & 2 && (s & UINT32_C(0x1c0)) != UINT32_C(0x1c0)) || (s & 4 && (s & UINT32_C(0x038)) != UINT32_C(0x038)))
    return 1;
{%- if h.method == "determinants" %}
  {
    /* Boxes, a plane, or five of the six edges separate; else one edge that pierces is enough. */
    unsigned missed = 0;
    for (unsigned i = 3; i < 9; i++)
      missed += s >> i & 1;
    if (separate != ((s & 7) || missed >= 5) || o & 7)
      return 1;
    return separate ? o != 0 : intersect != (o != 0);
  }
{%- else %}
  /* Triangles in one plane, or of which no edge hits the other, are separate if the first flag or no edge says otherwise. */
  if (separate != ((s & 1) || !(o & UINT32_C(0x1fa))) || separate == intersect)
    return 1;
  if ((separate && o & ~UINT32_C(2)) || (o & 2 && (s & ~UINT32_C(1) || o & UINT32_C(0x1f8))))
    return 1;
  return o & 4 && (!(o & 1) || !(o & UINT32_C(0x1fa)));
{%- endif %}
{%- endif %}
}

/* An answer that nobody can take for a verdict. */
static inline void {{ h.prefix }}efsat_void(struct {{ h.prefix }}efsat_answer *answer)
{
  memset(answer, 0, sizeof *answer);
  answer->verdict = {{ h.upper }}_VERDICT_REPORT;
  answer->malformed = 1;
}

/* An answer, of any packet. Refuses a word that no unit of this design sends. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_get_answer(struct {{ h.prefix }}efsat_answer *answer, const uint8_t word[{{ h.upper }}_ANSWER_BYTES],
    struct {{ h.prefix }}efsat_refusal *why)
{
  const unsigned end = {{ h.upper }}_ANSWER_OVERLAPPING_LOW + {{ h.upper }}_FLAG_BITS;
  uint64_t spare = {{ h.prefix }}efsat_get(word, {{ h.upper }}_ANSWER_MALFORMED - {% if h.has_outside %}2, 2{% else %}3, 3{% endif %});
  for (unsigned i = end; i < {{ h.upper }}_ANSWER_WORD_BITS; i++)
    spare |= {{ h.prefix }}efsat_get(word, i, 1);
  memset(answer, 0, sizeof *answer);
  answer->verdict = (unsigned){{ h.prefix }}efsat_get(word, {{ h.upper }}_ANSWER_VERDICT_LOW, 2);
  answer->reason = (unsigned){{ h.prefix }}efsat_get(word, {{ h.upper }}_ANSWER_REASON_LOW, 2);
{%- if h.has_outside %}
  answer->outside = (unsigned){{ h.prefix }}efsat_get(word, {{ h.upper }}_ANSWER_OUTSIDE, 1);
{%- endif %}
  answer->malformed = (unsigned){{ h.prefix }}efsat_get(word, {{ h.upper }}_ANSWER_MALFORMED, 1);
{%- if h.has_tag %}
  answer->tag = {{ h.prefix }}efsat_get(word, {{ h.upper }}_ANSWER_TAG_LOW, {{ h.upper }}_TAG_BITS);
{%- endif %}
  answer->separated = (uint32_t){{ h.prefix }}efsat_get(word, {{ h.upper }}_ANSWER_SEPARATED_LOW, {{ h.upper }}_FLAG_BITS);
  answer->overlapping = (uint32_t){{ h.prefix }}efsat_get(word, {{ h.upper }}_ANSWER_OVERLAPPING_LOW, {{ h.upper }}_FLAG_BITS);
  if (!spare && !{{ h.prefix }}efsat_contradicts(answer))
    return {{ h.prefix }}efsat_refuse(why, 0, 0, 0, 0, 0);
  {{ h.prefix }}efsat_void(answer);
  return {{ h.prefix }}efsat_refuse(why, {{ h.upper }}_REFUSED_ANSWER, 0, (int64_t){{ h.prefix }}efsat_get(word, 0, {{ h.upper }}_ANSWER_WORD_BITS < 64 ? {{ h.upper }}_ANSWER_WORD_BITS : 64), 0, 0);
}

/* The answers to a packet of `count` pairs{% if h.has_tag %} with these tags{% endif %}, from all bytes of its answer. Refuses answers that are not due, in number{% if h.has_tag %}, order{% endif %}
 * or kind; then no verdict of the packet counts. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_get_answers(struct {{ h.prefix }}efsat_answer *answers, uint32_t count{% if h.has_tag %}, const uint64_t *tags{% endif %},
    const uint8_t *bytes, size_t size, struct {{ h.prefix }}efsat_refusal *why)
{
  const size_t due = (size_t)count * {{ h.upper }}_ANSWER_BYTES;
  int refused = 0;
  for (uint32_t i = 0; i < count && !refused && ((size_t)i + 1) * {{ h.upper }}_ANSWER_BYTES <= size; i++) {
    refused = {{ h.prefix }}efsat_get_answer(&answers[i], bytes + (size_t)i * {{ h.upper }}_ANSWER_BYTES, why);
    if (refused && why)
      why->index = i;
    if (!refused && answers[i].verdict == {{ h.upper }}_VERDICT_REPORT)
      refused = {{ h.prefix }}efsat_refuse(why, {{ h.upper }}_REFUSED_REPORT, i, (int64_t)answers[i].reason, 0, 0);
{%- if h.has_tag %}
    if (!refused && answers[i].tag != tags[i])
      refused = {{ h.prefix }}efsat_refuse(why, {{ h.upper }}_REFUSED_ORDER, i, (int64_t)answers[i].tag, (int64_t)tags[i], (int64_t)tags[i]);
{%- endif %}
  }
  if (!refused)
    refused = {{ h.prefix }}efsat_refuse(why, size == due ? 0 : {{ h.upper }}_REFUSED_SIZE, {{ h.upper }}_NO_INDEX, (int64_t)size, (int64_t)due, (int64_t)due);
  for (uint32_t i = 0; i < count && refused; i++)
    {{ h.prefix }}efsat_void(&answers[i]);
  return refused;
}

#endif

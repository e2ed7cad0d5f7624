{% for line in h.header -%}
/* {{ line }} */
{% endfor -%}
/*
 * From a pose to the {% if h.by_number %}head of a packet of pairs{% else %}numbers of a query{% endif %} of {{ h.prefix }}efsat_engine in C99 and C++. All is computed in whole numbers from the bits of
 * binary64 numbers: no option of a compiler and no unit for floating point changes a word. Nothing is allocated.
 */
#ifndef {{ h.upper }}_POSE_H
#define {{ h.upper }}_POSE_H

#include "{{ h.file }}_image.h"
#include "{{ h.retest }}.h"

{% for group in h.pose -%}
/* {{ group.what }} */
{%- for constant in group.constants %}
#define {{ h.upper }}_{{ constant.upper() }} {{ constant.c() }} /* {{ constant.what }} */
{%- endfor %}
{% endfor %}
/* The floor of number * 2^shift, and whether the number is above it. What 62 bits do not hold is the greatest number or its opposite. */
static inline int64_t {{ h.prefix }}efsat_engine_floor(const struct {{ h.prefix }}efsat_retest_number *number, int shift, int *above)
{
  const int length = number->length ? 32 * (int)(number->length - 1) + {{ h.prefix }}efsat_retest_length(number->word[number->length - 1]) : 0;
  uint64_t whole = 0;
  uint32_t lost = 0;
  *above = 0;
  if (length + shift > 62)
    return number->sign < 0 ? -INT64_MAX : INT64_MAX;
  for (unsigned i = 0; i < number->length; i++) {
    const int place = 32 * (int)i + shift;
    if (place >= 0)
      whole |= (uint64_t)number->word[i] << place;
    else if (place <= -32)
      lost |= number->word[i];
    else {
      whole |= number->word[i] >> -place;
      lost |= number->word[i] << (32 + place);
    }
  }
  *above = lost != 0;
  return number->sign < 0 ? -(int64_t)whole - *above : (int64_t)whole;
}

/* Whether both images are for this engine and for each other. */
static inline int {{ h.prefix }}efsat_engine_check_images(const struct {{ h.prefix }}efsat_engine_image *const images[2], struct {{ h.prefix }}efsat_engine_refusal *why)
{
  int refused = 0;
{%- if !h.by_number %}
  for (uint32_t i = 0; i < 2 && !refused; i++) {
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_HEIGHT, i, images[i]->height, 0, {{ h.upper }}_TREE_HEIGHT);
    if (!refused)
      refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_BLOCKS, i, images[i]->blocks, 0, {{ h.upper }}_IMAGE_MOST_BLOCKS);
  }
{%- endif %}
  return refused ? refused : {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_SCALE, 1, images[1]->power, images[0]->power, images[0]->power);
}

/* The shift of a pose along an axis, 2^power (M c_B + t - c_A), in `room->images[0]` times 2^exponent. Returns 0 if the words are too few. */
static inline int {{ h.prefix }}efsat_engine_shift(struct {{ h.prefix }}efsat_retest_room *room, int *exponent, const struct {{ h.prefix }}efsat_engine_image *const images[2],
    const struct {{ h.prefix }}efsat_retest_part *row, const struct {{ h.prefix }}efsat_retest_part *t, unsigned axis)
{
  static const struct {{ h.prefix }}efsat_retest_part one = {1, 0, 1};
  const struct {{ h.prefix }}efsat_retest_part from = {{ h.prefix }}efsat_retest_split(images[0]->centre[axis]);
  struct {{ h.prefix }}efsat_retest_extent extent = {INT_MAX, INT_MIN};
  struct {{ h.prefix }}efsat_retest_number *const sum = &room->images[0];
  struct {{ h.prefix }}efsat_retest_part centre[3];
  sum->sign = 0;
  sum->length = 0;
  {{ h.prefix }}efsat_retest_extend(&extent, t, &one);
  {{ h.prefix }}efsat_retest_extend(&extent, &from, &one);
  for (unsigned i = 0; i < 3; i++) {
    centre[i] = {{ h.prefix }}efsat_retest_split(images[1]->centre[i]);
    {{ h.prefix }}efsat_retest_extend(&extent, &row[i], &centre[i]);
  }
  *exponent = 0;
  if (extent.most == INT_MIN)
    return 1;
  if (!{{ h.prefix }}efsat_retest_fits(&extent, 1))
    return 0;
  {{ h.prefix }}efsat_retest_add_product(sum, room->terms, t, &one, 1, extent.least);
  {{ h.prefix }}efsat_retest_add_product(sum, room->terms, &from, &one, -1, extent.least);
  for (unsigned i = 0; i < 3; i++)
    {{ h.prefix }}efsat_retest_add_product(sum, room->terms, &row[i], &centre[i], 1, extent.least);
  *exponent = extent.least + images[0]->power;
  return 1;
}
{% if !h.by_number %}
/* The matrix as multiples of 2^-{{ h.upper }}_FINE_BITS: floors, and whether entries are above. */
struct {{ h.prefix }}efsat_engine_matrix {
  int64_t floor[9];
  int above[9];
};

/* x / 2^drop, rounded down. */
static inline int64_t {{ h.prefix }}efsat_engine_down(int64_t x, unsigned drop)
{
  return x < 0 ? ~(~x >> drop) : x >> drop;
}

static inline int64_t {{ h.prefix }}efsat_engine_magnitude(int64_t x)
{
  return x < 0 ? -x : x;
}

/* What is missing from the place of an origin of B along an axis of A. */
static inline uint32_t {{ h.prefix }}efsat_engine_shift_error(const struct {{ h.prefix }}efsat_engine_matrix *fine, const int64_t pose[12], unsigned axis)
{
  int64_t missed = 0;
  for (unsigned i = 3 * axis; i < 3 * axis + 3; i++) {
    int64_t entry = {{ h.prefix }}efsat_engine_down(pose[i], {{ h.upper }}_MATRIX_SHIFT);
    entry = entry > {{ h.upper }}_BLOCK_MOST_ORIGIN ? {{ h.upper }}_BLOCK_MOST_ORIGIN : entry < -{{ h.upper }}_BLOCK_MOST_ORIGIN ? -{{ h.upper }}_BLOCK_MOST_ORIGIN : entry;
    missed += {{ h.prefix }}efsat_engine_magnitude(fine->floor[i] - entry * (INT64_C(1) << {{ h.upper }}_ORIGIN_DROP)) + fine->above[i];
  }
  return (uint32_t)(-{{ h.prefix }}efsat_engine_down(-missed, {{ h.upper }}_GRID_DROP) + {{ h.upper }}_SHIFT_ROUNDING);
}

/* A vector as a sum of three directions, of which none is of another slot than its place; their factors are doubled. The directions are
 * those for x >= y >= z >= 0, with axes and signs exchanged. */
static inline void {{ h.prefix }}efsat_engine_combine(uint32_t choices[3], int64_t doubled[3], const int64_t w[3])
{
  static const unsigned slots[3][{{ h.upper }}_DIRECTIONS] = { {{ h.choices }} };
  static const unsigned lengths[3] = { {{ h.slots }} };
  unsigned order[3] = {0, 1, 2}, form = 0, used = 0;
  for (unsigned i = 1; i < 3; i++)
    for (unsigned j = i; j > 0 && {{ h.prefix }}efsat_engine_magnitude(w[order[j]]) > {{ h.prefix }}efsat_engine_magnitude(w[order[j - 1]]); j--) {
      const unsigned axis = order[j];
      order[j] = order[j - 1];
      order[j - 1] = axis;
    }
  const int64_t x = {{ h.prefix }}efsat_engine_magnitude(w[order[0]]), y = {{ h.prefix }}efsat_engine_magnitude(w[order[1]]), z = {{ h.prefix }}efsat_engine_magnitude(w[order[2]]);
{%- if h.k == 6 %}
  static const int sorted[1][3][3] = { { {1, 0, 0}, {0, 1, 0}, {0, 0, 1} } };
  const int64_t factors[3] = {2 * x, 2 * y, 2 * z};
{%- else if h.k == 14 %}
  static const int sorted[1][3][3] = { { {1, 0, 0}, {1, 1, 1}, {1, 1, -1} } };
  const int64_t factors[3] = {2 * (x - y), y + z, y - z};
{%- else if h.k == 18 %}
  static const int sorted[2][3][3] = { { {1, 0, 0}, {1, 1, 0}, {1, 0, 1} }, { {1, 1, 0}, {1, 0, 1}, {0, 1, 1} } };
  int64_t factors[3] = {2 * (x - y - z), 2 * y, 2 * z};
  if (x < y + z) {
    form = 1;
    factors[0] = x + y - z;
    factors[1] = x + z - y;
    factors[2] = y + z - x;
  }
{%- else %}
  static const int sorted[1][3][3] = { { {1, 0, 0}, {1, 1, 0}, {1, 1, 1} } };
  const int64_t factors[3] = {2 * (x - y), 2 * (y - z), 2 * z};
{%- endif %}
  for (unsigned term = 0; term < 3; term++) {
    int n[3];
    for (unsigned i = 0; i < 3; i++)
      n[order[i]] = w[order[i]] < 0 ? -sorted[form][term][i] : sorted[form][term][i];
    for (unsigned slot = 0, found = 0; slot < 3 && !found; slot++)
      for (unsigned choice = 0; choice < lengths[slot] && !found && !(used >> slot & 1); choice++)
        if (!memcmp(n, {{ h.prefix }}efsat_engine_direction[slots[slot][choice]], sizeof n)) {
          choices[slot] = choice | slots[slot][choice] << 8;
          doubled[slot] = factors[term];
          used |= 1U << slot;
          found = 1;
        }
  }
}

/* The row of direction 2 * place; with the opposite directions it is that of the direction behind it. */
static inline int {{ h.prefix }}efsat_engine_fit_row(struct {{ h.prefix }}efsat_engine_row *row, uint32_t place, const struct {{ h.prefix }}efsat_engine_matrix *fine, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const int *const n = {{ h.prefix }}efsat_engine_direction[2 * place];
  int64_t w[3] = {0, 0, 0}, exact[3] = {0, 0, 0}, missed = 0, doubled[3] = {0, 0, 0}, rest;
  uint32_t choices[3] = {0, 0, 0};
  for (unsigned i = 0; i < 9; i++) {
    w[i % 3] += n[i / 3] * (fine->floor[i] + (fine->floor[i] < 0 ? fine->above[i] : 0));
    exact[i % 3] += n[i / 3] * fine->floor[i];
    missed += n[i / 3] ? fine->above[i] : 0;
  }
  {{ h.prefix }}efsat_engine_combine(choices, doubled, w);
  for (unsigned slot = 0; slot < 3; slot++) {
    const int64_t most = (INT64_C(1) << {{ h.upper }}_FACTOR_BITS) - 1;
    const int64_t factor = (doubled[slot] + (INT64_C(1) << {{ h.upper }}_FACTOR_DROP)) >> ({{ h.upper }}_FACTOR_DROP + 1);
    row->choice[slot] = choices[slot] & 255;
    row->factor[slot] = (uint32_t)(factor > most ? most : factor);
    for (unsigned axis = 0; axis < 3; axis++)
      exact[axis] -= {{ h.prefix }}efsat_engine_direction[choices[slot] >> 8][axis] * (row->factor[slot] * (INT64_C(1) << {{ h.upper }}_FACTOR_DROP));
  }
  for (unsigned axis = 0; axis < 3; axis++)
    missed += {{ h.prefix }}efsat_engine_magnitude(exact[axis]);
  rest = -{{ h.prefix }}efsat_engine_down(-missed * {{ h.upper }}_BLOCK_MOST_CODE, {{ h.upper }}_FACTOR_DROP);
  row->rest = (uint32_t)rest;
  return {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_REST, place, rest, 0, (INT64_C(1) << {{ h.upper }}_ROW_REST_BITS) - 1);
}
{% endif %}
/* Sets the pose{% if !h.by_number %}, errors and rows of a query{% else %} of a head{% endif %}, and nothing else of it: the mesh of the second image is moved to M x + t as seen from that of
 * the first, all in the coordinates of the meshes; M is row by row. Refuses what the engine cannot answer, which software then has to
 * do; the index of a number of the pose is that in `pose`. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_put_pose(struct {% if h.by_number %}{{ h.prefix }}efsat_engine_head *head{% else %}{{ h.prefix }}efsat_engine_query *query{% endif %}, struct {{ h.prefix }}efsat_retest_room *room,
    const struct {{ h.prefix }}efsat_engine_image *const images[2], const double m[9], const double t[3], struct {{ h.prefix }}efsat_engine_refusal *why)
{
  struct {{ h.prefix }}efsat_retest_part parts[12];
  int64_t pose[12];
  uint32_t sticky = 0;
  int refused = 0, above = 0;
{%- if !h.by_number %}
  struct {{ h.prefix }}efsat_engine_matrix fine;
{%- endif %}
  for (uint32_t i = 0; i < 12; i++) {
    const uint64_t bits = {{ h.prefix }}efsat_retest_bits(i < 9 ? &m[i] : &t[i - 9]);
    if (!{{ h.prefix }}efsat_retest_is_finite(bits))
      return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_NOT_FINITE, i, (int64_t)bits, 0, 0);
    parts[i] = {{ h.prefix }}efsat_retest_split(bits);
  }
  refused = {{ h.prefix }}efsat_engine_check_images(images, why);
  /* Row by row, with the shift behind each. */
  for (uint32_t step = 0; step < 12 && !refused; step++) {
    const uint32_t axis = step / 4, i = step % 4 == 3 ? 9 + axis : 3 * axis + step % 4;
    int exponent = parts[i].exponent;
    if (i < 9)
      {{ h.prefix }}efsat_retest_set(&room->images[0], &parts[i], 0);
    else if (!{{ h.prefix }}efsat_engine_shift(room, &exponent, images, &parts[3 * axis], &parts[i], axis))
      return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_WORDS, i, {{ h.retest_upper }}_WORDS, 0, 0);
    pose[i] = {{ h.prefix }}efsat_engine_floor(&room->images[0], exponent + {{ h.upper }}_FRACTION_BITS, &above);
    sticky |= (uint32_t)above << i;
    refused = i < 9 ? {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_ENTRY, i, pose[i], {{ h.upper }}_ENTRY_LEAST, {{ h.upper }}_ENTRY_MOST - above)
                    : {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_TRANSLATION, i, pose[i], {{ h.upper }}_TRANSLATION_LEAST, {{ h.upper }}_TRANSLATION_MOST - above);
{%- if !h.by_number %}
    if (i < 9)
      fine.floor[i] = {{ h.prefix }}efsat_engine_floor(&room->images[0], exponent + {{ h.upper }}_FINE_BITS, &fine.above[i]);
{%- endif %}
  }
{%- if h.by_number %}
  if (refused)
    return refused;
  memcpy(head->pose, pose, sizeof pose);
  head->as_it_lies = 0;
  {% if h.is_sticky %}head->sticky = sticky{% else %}(void)sticky{% endif %};
{%- else %}
  for (uint32_t i = 0; i < {{ h.upper }}_ROWS && !refused; i++)
    refused = {{ h.prefix }}efsat_engine_fit_row(&query->rows[i], i, &fine, why);
  if (refused)
    return refused;
  memcpy(query->pose, pose, sizeof pose);
  for (unsigned i = 0; i < 3; i++)
    query->errors[i] = {{ h.prefix }}efsat_engine_shift_error(&fine, pose, i);
  {% if h.is_sticky %}query->sticky = sticky{% else %}(void)sticky{% endif %};
{%- endif %}
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}

#endif

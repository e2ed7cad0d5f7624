{% for line in h.header -%}
/* {{ line }} */
{% endfor -%}
/*
 * The exact answer for two triangles in C99 and C++, for pairs that are possibly incorrect: any finite binary64 numbers, segments and
 * points too. All is computed in whole numbers: no option of a compiler and no unit for floating point changes an answer. Nothing is
 * allocated: the caller lends the room, of {{ h.upper }}_WORDS words per number, which is enough for every pair. Define fewer to save
 * memory; a pair that needs more is then refused.
 *
 * With P = A - B the triangles have a common point if 0 is in P, and their insides meet if it is in the inside of P. Normals of P
 * decide: those of A and of B, the nine products of an edge of each, and, if all of these lie along one line, directions across the
 * edges as seen along an axis.
 */
#ifndef {{ h.upper }}_H
#define {{ h.upper }}_H

#include <limits.h>
#include <stdint.h>
#include <string.h>

/* Words of 32 bits of a number. The room takes about 150 bytes for each. */
#ifndef {{ h.upper }}_WORDS
#define {{ h.upper }}_WORDS 396
#endif

/* How two triangles lie to each other. */
#define {{ h.upper }}_SEPARATE 0 /* no common point */
#define {{ h.upper }}_TOUCH 1 /* common points, but none inside of both */
#define {{ h.upper }}_INTERSECT 2 /* the insides meet, in one plane too */

{% include "host/refusal.h" %}
/* A whole number: -1, 0 or 1, and words, the lowest first, of which the highest is not 0. */
struct {{ h.prefix }}efsat_retest_number {
  int sign;
  unsigned length;
  uint32_t word[{{ h.upper }}_WORDS];
};

/* What a retest works in; it need not be set. */
struct {{ h.prefix }}efsat_retest_room {
  struct {{ h.prefix }}efsat_retest_number points[6][3], edges[2][3], direction[3], images[6], terms[3];
};

/* The compiler stops here if a number is not binary64, or the words are too few for any. */
typedef char {{ h.prefix }}efsat_retest_is_binary64[sizeof(double) == 8 && {{ h.upper }}_WORDS >= 16 ? 1 : -1];

/* A finite number as sign * magnitude * 2^exponent, the magnitude odd or 0. */
struct {{ h.prefix }}efsat_retest_part {
  int sign;
  int exponent;
  uint64_t magnitude;
};

/* The bits of a number. */
static inline uint64_t {{ h.prefix }}efsat_retest_bits(const double *number)
{
  uint64_t bits;
  memcpy(&bits, number, sizeof bits);
  return bits;
}

static inline int {{ h.prefix }}efsat_retest_is_finite(uint64_t bits)
{
  return (bits >> 52 & 0x7ff) != 0x7ff;
}

static inline struct {{ h.prefix }}efsat_retest_part {{ h.prefix }}efsat_retest_split(uint64_t bits)
{
  struct {{ h.prefix }}efsat_retest_part part;
  const int field = (int)(bits >> 52 & 0x7ff);
  part.magnitude = (bits & ((UINT64_C(1) << 52) - 1)) | (field ? UINT64_C(1) << 52 : 0);
  part.sign = part.magnitude == 0 ? 0 : bits >> 63 ? -1 : 1;
  part.exponent = (field ? field : 1) - 1075;
  while (part.magnitude && !(part.magnitude & 1)) {
    part.magnitude >>= 1;
    part.exponent++;
  }
  return part;
}

/* The least n with a magnitude below 2^n. */
static inline int {{ h.prefix }}efsat_retest_length(uint64_t magnitude)
{
  int length = 0;
  while (magnitude) {
    magnitude >>= 1;
    length++;
  }
  return length;
}

static inline void {{ h.prefix }}efsat_retest_trim(struct {{ h.prefix }}efsat_retest_number *x)
{
  while (x->length && !x->word[x->length - 1])
    x->length--;
  if (!x->length)
    x->sign = 0;
}

/* x = part * 2^shift, for a shift that makes it whole. */
static inline void {{ h.prefix }}efsat_retest_set(struct {{ h.prefix }}efsat_retest_number *x, const struct {{ h.prefix }}efsat_retest_part *part, int shift)
{
  const unsigned whole = (unsigned)shift / 32, rest = (unsigned)shift % 32;
  x->sign = part->sign;
  x->length = 0;
  if (!part->sign)
    return;
  memset(x->word, 0, whole * sizeof *x->word);
  x->word[whole] = (uint32_t)(part->magnitude << rest);
  x->word[whole + 1] = (uint32_t)(part->magnitude >> (32 - rest));
  x->word[whole + 2] = (uint32_t)(part->magnitude >> 32 >> (32 - rest));
  x->length = whole + 3;
  {{ h.prefix }}efsat_retest_trim(x);
}

static inline int {{ h.prefix }}efsat_retest_compare_magnitudes(const struct {{ h.prefix }}efsat_retest_number *a, const struct {{ h.prefix }}efsat_retest_number *b)
{
  unsigned i = a->length;
  if (a->length != b->length)
    return a->length < b->length ? -1 : 1;
  while (i && a->word[i - 1] == b->word[i - 1])
    i--;
  return i == 0 ? 0 : a->word[i - 1] < b->word[i - 1] ? -1 : 1;
}

static inline int {{ h.prefix }}efsat_retest_compare(const struct {{ h.prefix }}efsat_retest_number *a, const struct {{ h.prefix }}efsat_retest_number *b)
{
  if (a->sign != b->sign)
    return a->sign < b->sign ? -1 : 1;
  return a->sign * {{ h.prefix }}efsat_retest_compare_magnitudes(a, b);
}

/* sum = a + sign * b; the sum may be one of them. */
static inline void {{ h.prefix }}efsat_retest_add(struct {{ h.prefix }}efsat_retest_number *sum, const struct {{ h.prefix }}efsat_retest_number *a, const struct {{ h.prefix }}efsat_retest_number *b,
    int sign)
{
  const int order = {{ h.prefix }}efsat_retest_compare_magnitudes(a, b), other = sign * b->sign;
  const struct {{ h.prefix }}efsat_retest_number *const great = order < 0 ? b : a, *const small = order < 0 ? a : b;
  const unsigned length = great->length, shorter = small->length;
  /* A difference is the sum with the complement, without its carry. */
  const uint32_t complement = a->sign * other < 0 ? UINT32_MAX : 0;
  uint64_t carry = complement & 1;
  sum->sign = order < 0 ? other : a->sign;
  for (unsigned i = 0; i < length; i++) {
    carry += (uint64_t)great->word[i] + ((i < shorter ? small->word[i] : 0) ^ complement);
    sum->word[i] = (uint32_t)carry;
    carry >>= 32;
  }
  sum->length = length;
  if (carry && !complement)
    sum->word[sum->length++] = (uint32_t)carry;
  {{ h.prefix }}efsat_retest_trim(sum);
}

/* product = a * b; it is none of them. */
static inline void {{ h.prefix }}efsat_retest_multiply(struct {{ h.prefix }}efsat_retest_number *product, const struct {{ h.prefix }}efsat_retest_number *a,
    const struct {{ h.prefix }}efsat_retest_number *b)
{
  product->sign = a->sign * b->sign;
  product->length = product->sign ? a->length + b->length : 0;
  memset(product->word, 0, product->length * sizeof *product->word);
  for (unsigned i = 0; i < a->length && product->sign; i++) {
    uint64_t carry = 0;
    for (unsigned j = 0; j < b->length; j++) {
      carry += (uint64_t)a->word[i] * b->word[j] + product->word[i + j];
      product->word[i + j] = (uint32_t)carry;
      carry >>= 32;
    }
    product->word[i + b->length] = (uint32_t)carry;
  }
  {{ h.prefix }}efsat_retest_trim(product);
}

/* Up to which powers of two products reach. */
struct {{ h.prefix }}efsat_retest_extent {
  int least;
  int most;
};

static inline void {{ h.prefix }}efsat_retest_extend(struct {{ h.prefix }}efsat_retest_extent *extent, const struct {{ h.prefix }}efsat_retest_part *x,
    const struct {{ h.prefix }}efsat_retest_part *y)
{
  const int exponent = x->exponent + y->exponent;
  const int end = exponent + {{ h.prefix }}efsat_retest_length(x->magnitude) + {{ h.prefix }}efsat_retest_length(y->magnitude);
  if (!x->sign || !y->sign)
    return;
  if (exponent < extent->least)
    extent->least = exponent;
  if (end > extent->most)
    extent->most = end;
}

/* sum += sign * x * y, in units of 2^least. */
static inline void {{ h.prefix }}efsat_retest_add_product(struct {{ h.prefix }}efsat_retest_number *sum, struct {{ h.prefix }}efsat_retest_number terms[3],
    const struct {{ h.prefix }}efsat_retest_part *x, const struct {{ h.prefix }}efsat_retest_part *y, int sign, int least)
{
  if (!x->sign || !y->sign)
    return;
  {{ h.prefix }}efsat_retest_set(&terms[0], x, x->exponent + y->exponent - least);
  {{ h.prefix }}efsat_retest_set(&terms[1], y, 0);
  {{ h.prefix }}efsat_retest_multiply(&terms[2], &terms[0], &terms[1]);
  {{ h.prefix }}efsat_retest_add(sum, sum, &terms[2], sign);
}

/* Whether numbers of so many factors have the words, each factor a sum of five products or a difference of two such sums. */
static inline int {{ h.prefix }}efsat_retest_fits(const struct {{ h.prefix }}efsat_retest_extent *extent, int factors)
{
  return factors * (extent->most - extent->least + 3) + 3 <= 32 * ({{ h.upper }}_WORDS - 2);
}

/* The corners of A, and those of B moved to M x + t, all seen from the first one of A; parts are a0 to b2, M row by row, and t. */
static inline int {{ h.prefix }}efsat_retest_place(struct {{ h.prefix }}efsat_retest_room *room, const struct {{ h.prefix }}efsat_retest_part parts[30])
{
  static const struct {{ h.prefix }}efsat_retest_part one = {1, 0, 1};
  struct {{ h.prefix }}efsat_retest_extent extent = {INT_MAX, INT_MIN};
  for (unsigned i = 0; i < 9; i++) {
    {{ h.prefix }}efsat_retest_extend(&extent, &parts[i], &one);
    for (unsigned j = 0; j < 3; j++)
      {{ h.prefix }}efsat_retest_extend(&extent, &parts[18 + i / 3 * 3 + j], &parts[9 + i % 3 * 3 + j]);
  }
  for (unsigned i = 27; i < 30; i++)
    {{ h.prefix }}efsat_retest_extend(&extent, &parts[i], &one);
  if (extent.most == INT_MIN)
    extent.least = extent.most = 0;
  if (!{{ h.prefix }}efsat_retest_fits(&extent, 3))
    return 0;
  for (unsigned corner = 0; corner < 6; corner++)
    for (unsigned axis = 0; axis < 3; axis++) {
      struct {{ h.prefix }}efsat_retest_number *const at = &room->points[corner][axis];
      at->sign = 0;
      at->length = 0;
      {{ h.prefix }}efsat_retest_add_product(at, room->terms, &parts[axis], &one, -1, extent.least);
      if (corner < 3) {
        {{ h.prefix }}efsat_retest_add_product(at, room->terms, &parts[3 * corner + axis], &one, 1, extent.least);
        continue;
      }
      {{ h.prefix }}efsat_retest_add_product(at, room->terms, &parts[27 + axis], &one, 1, extent.least);
      for (unsigned j = 0; j < 3; j++)
        {{ h.prefix }}efsat_retest_add_product(at, room->terms, &parts[18 + 3 * axis + j], &parts[3 * corner + j], 1, extent.least);
    }
  return 1;
}

/* An edge of a triangle, from one corner to the next. */
static inline void {{ h.prefix }}efsat_retest_edge(struct {{ h.prefix }}efsat_retest_room *room, unsigned place, unsigned triangle, unsigned edge)
{
  for (unsigned i = 0; i < 3; i++)
    {{ h.prefix }}efsat_retest_add(&room->edges[place][i], &room->points[3 * triangle + (edge + 1) % 3][i], &room->points[3 * triangle + edge][i], -1);
}

/* The direction across both edges; returns an axis along which it is not 0, or -1. */
static inline int {{ h.prefix }}efsat_retest_cross(struct {{ h.prefix }}efsat_retest_room *room)
{
  int axis = -1;
  for (unsigned i = 0; i < 3; i++) {
    const unsigned j = (i + 1) % 3, k = (i + 2) % 3;
    {{ h.prefix }}efsat_retest_multiply(&room->terms[0], &room->edges[0][j], &room->edges[1][k]);
    {{ h.prefix }}efsat_retest_multiply(&room->terms[1], &room->edges[0][k], &room->edges[1][j]);
    {{ h.prefix }}efsat_retest_add(&room->direction[i], &room->terms[0], &room->terms[1], -1);
    if (room->direction[i].sign)
      axis = (int)i;
  }
  return axis;
}

/* What directions have shown: no common point, none inside of both, and that some image is longer than a point. */
struct {{ h.prefix }}efsat_retest_evidence {
  int apart;
  int properly_apart;
  int extended;
};

/* Tests the direction, either way. */
static inline void {{ h.prefix }}efsat_retest_test(struct {{ h.prefix }}efsat_retest_room *room, struct {{ h.prefix }}efsat_retest_evidence *evidence)
{
  unsigned least[2] = {0, 3}, most[2] = {0, 3};
  int a_below, b_below, longer;
  for (unsigned corner = 0; corner < 6; corner++) {
    struct {{ h.prefix }}efsat_retest_number *const image = &room->images[corner];
    image->sign = 0;
    image->length = 0;
    for (unsigned i = 0; i < 3; i++) {
      {{ h.prefix }}efsat_retest_multiply(&room->terms[0], &room->points[corner][i], &room->direction[i]);
      {{ h.prefix }}efsat_retest_add(image, image, &room->terms[0], 1);
    }
    if ({{ h.prefix }}efsat_retest_compare(image, &room->images[least[corner / 3]]) < 0)
      least[corner / 3] = corner;
    if ({{ h.prefix }}efsat_retest_compare(image, &room->images[most[corner / 3]]) > 0)
      most[corner / 3] = corner;
  }
  a_below = {{ h.prefix }}efsat_retest_compare(&room->images[most[0]], &room->images[least[1]]);
  b_below = {{ h.prefix }}efsat_retest_compare(&room->images[most[1]], &room->images[least[0]]);
  longer = {{ h.prefix }}efsat_retest_compare(&room->images[least[0]], &room->images[most[0]]) < 0 || {{ h.prefix }}efsat_retest_compare(&room->images[least[1]], &room->images[most[1]]) < 0;
  evidence->apart |= a_below < 0 || b_below < 0;
  evidence->properly_apart |= longer && (a_below <= 0 || b_below <= 0);
  evidence->extended |= longer;
}

static inline int {{ h.prefix }}efsat_retest_answer(const struct {{ h.prefix }}efsat_retest_evidence *evidence)
{
  return evidence->apart ? {{ h.upper }}_SEPARATE : evidence->properly_apart ? {{ h.upper }}_TOUCH : {{ h.upper }}_INTERSECT;
}

/* The answer for triangles of which all edges lie in a plane, which is seen as it is along an axis. */
static inline int {{ h.prefix }}efsat_retest_in_plane(struct {{ h.prefix }}efsat_retest_room *room, struct {{ h.prefix }}efsat_retest_evidence *evidence, unsigned axis)
{
  const unsigned j = (axis + 1) % 3, k = (axis + 2) % 3;
  for (unsigned i = 0; i < 6; i++) {
    {{ h.prefix }}efsat_retest_edge(room, 0, i / 3, i % 3);
    room->direction[axis].sign = 0;
    room->direction[axis].length = 0;
    room->direction[j] = room->edges[0][k];
    room->direction[j].sign = -room->direction[j].sign;
    room->direction[k] = room->edges[0][j];
    {{ h.prefix }}efsat_retest_test(room, evidence);
  }
  return {{ h.prefix }}efsat_retest_answer(evidence);
}

/* The answer for triangles of which all edges are parallel: they are on one line, or on two. */
static inline int {{ h.prefix }}efsat_retest_on_lines(struct {{ h.prefix }}efsat_retest_room *room, struct {{ h.prefix }}efsat_retest_evidence *evidence)
{
  for (unsigned i = 0; i < 6; i++) {
    {{ h.prefix }}efsat_retest_edge(room, 1, i / 3, i % 3);
    if (room->edges[1][0].sign || room->edges[1][1].sign || room->edges[1][2].sign)
      break;
  }
  memcpy(room->direction, room->edges[1], sizeof room->direction);
  {{ h.prefix }}efsat_retest_test(room, evidence);
  for (unsigned i = 0; i < 3; i++)
    {{ h.prefix }}efsat_retest_add(&room->edges[0][i], &room->points[0][i], &room->points[3][i], -1);
  /* Of two points all differences count, else those across the line. */
  if (!evidence->extended)
    return room->edges[0][0].sign || room->edges[0][1].sign || room->edges[0][2].sign ? {{ h.upper }}_SEPARATE : {{ h.upper }}_INTERSECT;
  return {{ h.prefix }}efsat_retest_cross(room) < 0 ? {{ h.prefix }}efsat_retest_answer(evidence) : {{ h.upper }}_SEPARATE;
}

static inline int {{ h.prefix }}efsat_retest_decide(struct {{ h.prefix }}efsat_retest_room *room)
{
  struct {{ h.prefix }}efsat_retest_evidence evidence = {0, 0, 0};
  int plane = -1;
  for (unsigned i = 0; i < 11; i++) {
    /* The edges 0 and 1 of A, those of B, then one of each. */
    {{ h.prefix }}efsat_retest_edge(room, 0, i == 1, i < 2 ? 0 : (i - 2) / 3);
    {{ h.prefix }}efsat_retest_edge(room, 1, i != 0, i < 2 ? 1 : (i - 2) % 3);
    const int axis = {{ h.prefix }}efsat_retest_cross(room);
    if (axis < 0)
      continue;
    {{ h.prefix }}efsat_retest_test(room, &evidence);
    if (evidence.apart)
      return {{ h.upper }}_SEPARATE;
    plane = axis;
  }
  if (evidence.extended)
    return {{ h.prefix }}efsat_retest_answer(&evidence);
  return plane < 0 ? {{ h.prefix }}efsat_retest_on_lines(room, &evidence) : {{ h.prefix }}efsat_retest_in_plane(room, &evidence, (unsigned)plane);
}

/* How a triangle A, corner by corner, and a triangle B that is moved to M x + t lie to each other, exactly; M is row by row. The image
 * is not rounded. Refuses what is not finite: numbers 0 to 8 are A, 9 to 17 B, 18 to 26 M, 27 to 29 t. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_retest_posed(int *answer, struct {{ h.prefix }}efsat_retest_room *room, const double a[9], const double b[9],
    const double m[9], const double t[3], struct {{ h.prefix }}efsat_retest_refusal *why)
{
  struct {{ h.prefix }}efsat_retest_part parts[30];
  for (uint32_t i = 0; i < 30; i++) {
    const uint64_t bits = {{ h.prefix }}efsat_retest_bits(i < 9 ? &a[i] : i < 18 ? &b[i - 9] : i < 27 ? &m[i - 18] : &t[i - 27]);
    if (!{{ h.prefix }}efsat_retest_is_finite(bits))
      return {{ h.prefix }}efsat_retest_refuse(why, {{ h.upper }}_REFUSED_NOT_FINITE, i, (int64_t)bits, 0, 0);
    parts[i] = {{ h.prefix }}efsat_retest_split(bits);
  }
  if (!{{ h.prefix }}efsat_retest_place(room, parts))
    return {{ h.prefix }}efsat_retest_refuse(why, {{ h.upper }}_REFUSED_WORDS, {{ h.upper }}_NO_INDEX, {{ h.upper }}_WORDS, 0, 0);
  *answer = {{ h.prefix }}efsat_retest_decide(room);
  return {{ h.prefix }}efsat_retest_refuse(why, 0, 0, 0, 0, 0);
}

/* The same for two triangles as they lie. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_retest_pair(int *answer, struct {{ h.prefix }}efsat_retest_room *room, const double a[9], const double b[9],
    struct {{ h.prefix }}efsat_retest_refusal *why)
{
  static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, zero[3] = {0, 0, 0};
  return {{ h.prefix }}efsat_retest_posed(answer, room, a, b, one, zero, why);
}

#endif

{% for line in h.header -%}
/* {{ line }} */
{% endfor -%}
/*
 * Images of meshes for {{ h.prefix }}efsat_engine in C99 and C++: a file of `efsat tree build` as bytes in memory, which are read one by one,
 * so that the order of bytes of a machine does not matter. Nothing is allocated. The engine reads the same bytes.
 */
#ifndef {{ h.upper }}_IMAGE_H
#define {{ h.upper }}_IMAGE_H

#include "{{ h.file }}.h"
{% for group in h.image %}
/* {{ group.what }} */
{%- for constant in group.constants %}
#define {{ h.upper }}_{{ constant.upper() }} {{ constant.c() }} /* {{ constant.what }} */
{%- endfor %}
{% endfor %}
/* Words that `{{ h.prefix }}efsat_engine_check_image` works in. */
#define {{ h.upper }}_SCRATCH_WORDS(triangles) (2 * (size_t)(triangles) + (triangles) / 32 + 3)

/* The directions of volumes. */
static const int {{ h.prefix }}efsat_engine_direction[{{ h.upper }}_IMAGE_DIRECTIONS][3] = { {{ h.vectors }} };

/* An image: the bytes of the file, and what its header says. The scale of the mesh is 2^power; its centre is three binary64 numbers,
 * here their bits. */
struct {{ h.prefix }}efsat_engine_image {
  const uint8_t *bytes;
  uint32_t blocks;
  uint32_t triangles;
  int32_t power;
  uint32_t height;
  uint64_t centre[3];
};

/* Up to 64 bits from a place on; the first bit is the lowest one of the first byte. */
static inline uint64_t {{ h.prefix }}efsat_engine_image_field(const uint8_t *bytes, unsigned at, unsigned bits)
{
  uint64_t value = 0;
  unsigned i = 0;
  while (i < bits) {
    value |= (uint64_t)(bytes[(at + i) / 8] >> (at + i) % 8) << i;
    i += 8 - (at + i) % 8;
  }
  return value & UINT64_MAX >> (64 - bits);
}

/* Whether one of the bits of a record from one to below another is set. */
static inline int {{ h.prefix }}efsat_engine_image_used(const uint8_t *bytes, unsigned from, unsigned to)
{
  for (; from < to; from += 32)
    if ({{ h.prefix }}efsat_engine_image_field(bytes, from, to - from < 32 ? to - from : 32))
      return 1;
  return 0;
}

/* The same with a sign, of less than 64 bits. */
static inline int64_t {{ h.prefix }}efsat_engine_image_signed(const uint8_t *bytes, unsigned at, unsigned bits)
{
  const uint64_t sign = UINT64_C(1) << (bits - 1);
  return (int64_t)({{ h.prefix }}efsat_engine_image_field(bytes, at, bits) ^ sign) - (int64_t)sign;
}

/* A word of 64 bits of an image, by its place: what a load takes. */
static inline uint64_t {{ h.prefix }}efsat_engine_image_word(const struct {{ h.prefix }}efsat_engine_image *image, size_t place)
{
  return {{ h.prefix }}efsat_engine_image_field(image->bytes + 8 * place, 0, 64);
}

/* The byte of a block, and of a triangle by its place; that of the triangle behind the last one is the size of the image. */
static inline uint64_t {{ h.prefix }}efsat_engine_image_block(uint32_t block)
{
  return {{ h.upper }}_IMAGE_HEADER_BYTES + (uint64_t)block * {{ h.upper }}_IMAGE_BLOCK_BYTES;
}

static inline uint64_t {{ h.prefix }}efsat_engine_image_triangle(const struct {{ h.prefix }}efsat_engine_image *image, uint32_t place)
{
  const uint64_t end = {{ h.prefix }}efsat_engine_image_block(image->blocks);
  return (end + 63) / 64 * 64 + (uint64_t)place * {{ h.upper }}_IMAGE_TRIANGLE_BYTES;
}

/* The face of a triangle by its place: the number in answers. */
static inline uint32_t {{ h.prefix }}efsat_engine_image_face(const struct {{ h.prefix }}efsat_engine_image *image, uint32_t place)
{
  return (uint32_t){{ h.prefix }}efsat_engine_image_field(image->bytes + {{ h.prefix }}efsat_engine_image_triangle(image, place), 0, {{ h.upper }}_IMAGE_FACE_BITS);
}
{% if h.block_ram %}
/* An image of which triangles{% if !h.by_number %} and blocks{% endif %} are loaded from these addresses on. */
static inline struct {{ h.prefix }}efsat_engine_side {{ h.prefix }}efsat_engine_image_side(const struct {{ h.prefix }}efsat_engine_image *image{% if !h.by_number %}, uint64_t blocks_at{% endif %}, uint64_t triangles_at)
{
  struct {{ h.prefix }}efsat_engine_side side;
{%- if !h.by_number %}
  side.blocks_at = blocks_at;
  side.blocks = image->blocks;
{%- endif %}
  side.triangles_at = triangles_at;
{%- else %}
/* An image that is copied to an address, a multiple of 64. */
static inline struct {{ h.prefix }}efsat_engine_side {{ h.prefix }}efsat_engine_image_side(const struct {{ h.prefix }}efsat_engine_image *image, uint64_t address)
{
  struct {{ h.prefix }}efsat_engine_side side;
{%- if !h.by_number %}
  side.blocks_at = address + {{ h.prefix }}efsat_engine_image_block(0);
  side.blocks = image->blocks;
{%- endif %}
  side.triangles_at = address + {{ h.prefix }}efsat_engine_image_triangle(image, 0);
{%- endif %}
  side.triangles = image->triangles;
  return side;
}

/* Reads the header of an image of so many bytes, which have to stay, and checks it. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_read_image(struct {{ h.prefix }}efsat_engine_image *image, const uint8_t *bytes, size_t size,
    struct {{ h.prefix }}efsat_engine_refusal *why)
{
  static const uint8_t head[16] = { {{ h.head }} };
  struct {{ h.prefix }}efsat_engine_image read;
  int refused = size < {{ h.upper }}_IMAGE_HEADER_BYTES
      ? {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_IMAGE_SIZE, {{ h.upper }}_NO_INDEX, (int64_t)size, {{ h.upper }}_IMAGE_HEADER_BYTES, INT64_MAX) : 0;
  for (uint32_t i = 0; i < 16 && !refused; i++)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, i, bytes[i], head[i], head[i]);
  if (refused)
    return refused;
  read.bytes = bytes;
  read.blocks = (uint32_t){{ h.prefix }}efsat_engine_image_field(bytes, 128, 32);
  read.triangles = (uint32_t){{ h.prefix }}efsat_engine_image_field(bytes, 160, 32);
  read.power = (int32_t){{ h.prefix }}efsat_engine_image_signed(bytes, 256, 32);
  read.height = (uint32_t){{ h.prefix }}efsat_engine_image_field(bytes, 288, 32);
  const int64_t blocks = read.triangles > 1 ? (int64_t)read.triangles - 1 : 1, from = (int64_t){{ h.prefix }}efsat_engine_image_block(0);
  refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, 20, read.triangles, 0, {{ h.upper }}_IMAGE_MOST_TRIANGLES);
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, 16, read.blocks, blocks, blocks);
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, 24, (int64_t){{ h.prefix }}efsat_engine_image_field(bytes, 192, 32), from, from);
  if (refused)
    return refused;
  const int64_t to = (int64_t){{ h.prefix }}efsat_engine_image_triangle(&read, 0), end = (int64_t){{ h.prefix }}efsat_engine_image_triangle(&read, read.triangles);
  refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, 28, (int64_t){{ h.prefix }}efsat_engine_image_field(bytes, 224, 32), to, to);
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, 32, read.power, -1024, 1022);
  for (uint32_t i = 0; i < 3 && !refused; i++) {
    read.centre[i] = {{ h.prefix }}efsat_engine_image_field(bytes, 320 + 64 * i, 64);
    if ((read.centre[i] >> 52 & 0x7ff) == 0x7ff)
      refused = {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, 40 + 8 * i, (int64_t)read.centre[i], 0, 0);
  }
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_SIZE, {{ h.upper }}_NO_INDEX, (int64_t)size, end, end);
  if (!refused)
    *image = read;
  return refused;
}

/* Whether the fields of a block are such as the format has. */
static inline int {{ h.prefix }}efsat_engine_check_block(const struct {{ h.prefix }}efsat_engine_image *image, uint32_t number, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const uint64_t at = {{ h.prefix }}efsat_engine_image_block(number);
  const uint8_t *const block = image->bytes + at;
  int refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t)at,
      (int64_t){{ h.prefix }}efsat_engine_image_field(block, {{ h.upper }}_BLOCK_TAG_LOW, {{ h.upper }}_BLOCK_CODES_LOW - {{ h.upper }}_BLOCK_TAG_LOW), {{ h.upper }}_BLOCK_TAG, {{ h.upper }}_BLOCK_TAG);
  for (unsigned i = 0; i < 2 * {{ h.upper }}_IMAGE_DIRECTIONS && !refused; i++)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t)at,
        {{ h.prefix }}efsat_engine_image_signed(block, {{ h.upper }}_BLOCK_CODES_LOW + i * {{ h.upper }}_BLOCK_CODE_BITS, {{ h.upper }}_BLOCK_CODE_BITS), -{{ h.upper }}_BLOCK_MOST_CODE, {{ h.upper }}_BLOCK_MOST_CODE);
  for (unsigned i = 0; i < 3 && !refused; i++)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t)at,
        {{ h.prefix }}efsat_engine_image_signed(block, 64 + i * {{ h.upper }}_BLOCK_ORIGIN_BITS, {{ h.upper }}_BLOCK_ORIGIN_BITS), -{{ h.upper }}_BLOCK_MOST_ORIGIN, {{ h.upper }}_BLOCK_MOST_ORIGIN);
  for (unsigned i = 0; i < 2 && !refused; i++) {
    const uint32_t link = (uint32_t){{ h.prefix }}efsat_engine_image_field(block, 32 * i, 32);
    const uint32_t count = link >> 31 ? image->triangles : image->blocks;
    if (link != UINT32_MAX)
      refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t)at, link & INT32_MAX, 0, (int64_t)count - 1);
  }
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t)at, {{ h.prefix }}efsat_engine_image_used(block, {{ h.upper }}_BLOCK_BITS, 8 * {{ h.upper }}_IMAGE_BLOCK_BYTES), 0, 0);
  return refused;
}

/* Where the links of blocks lead, for the check of a tree: the link that leads to each block, twice the number of its block and 1 if
 * it is the right one, or UINT32_MAX; the level of each block; a bit for each triangle. */
struct {{ h.prefix }}efsat_engine_links {
  uint32_t *from;
  uint32_t *level;
  uint32_t *seen;
  uint32_t height;
};

/* A bit for each of so many triangles: none is set; that of one is, and whether it was not before. */
static inline void {{ h.prefix }}efsat_engine_image_forget(uint32_t *seen, uint32_t triangles)
{
  for (uint32_t i = 0; i < (triangles + 31) / 32; i++)
    seen[i] = 0;
}

static inline int {{ h.prefix }}efsat_engine_image_take(uint32_t *seen, uint32_t triangle)
{
  const uint32_t bit = UINT32_C(1) << triangle % 32;
  const int taken = !(seen[triangle / 32] & bit);
  seen[triangle / 32] |= bit;
  return taken;
}

/* Whether a link leads to a triangle or a block that no other link leads to; blocks come after their parents. */
static inline int {{ h.prefix }}efsat_engine_check_link(const struct {{ h.prefix }}efsat_engine_image *image, struct {{ h.prefix }}efsat_engine_links *links, uint32_t number, uint32_t child)
{
  const uint32_t link = (uint32_t){{ h.prefix }}efsat_engine_image_field(image->bytes + {{ h.prefix }}efsat_engine_image_block(number), 32 * child, 32);
  const uint32_t other = link & INT32_MAX;
  /* Only meshes of less than two triangles lack children. */
  if (link == UINT32_MAX || (image->triangles < 2 && child >= image->triangles))
    return link == UINT32_MAX && image->triangles < 2 && child >= image->triangles;
  if (link >> 31) {
    if (links->level[number] > links->height)
      links->height = links->level[number];
    return {{ h.prefix }}efsat_engine_image_take(links->seen, other);
  }
  if (other <= number || links->from[other] != UINT32_MAX)
    return 0;
  links->from[other] = 2 * number + child;
  links->level[other] = links->level[number] + 1;
  return 1;
}

/* Whether the blocks are one tree over all triangles, of the height in the header. */
static inline int {{ h.prefix }}efsat_engine_check_tree(const struct {{ h.prefix }}efsat_engine_image *image, struct {{ h.prefix }}efsat_engine_links *links, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  int refused = 0;
  for (uint32_t i = 0; i < image->blocks; i++)
    links->from[i] = UINT32_MAX;
  {{ h.prefix }}efsat_engine_image_forget(links->seen, image->triangles);
  links->level[0] = 1;
  links->height = 0;
  for (uint32_t i = 0; i < image->blocks && !refused; i++) {
    refused = {{ h.prefix }}efsat_engine_check_block(image, i, why);
    if (!refused && ((i && links->from[i] == UINT32_MAX) || !{{ h.prefix }}efsat_engine_check_link(image, links, i, 0) || !{{ h.prefix }}efsat_engine_check_link(image, links, i, 1)))
      refused = {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_IMAGE_LINK, (uint32_t){{ h.prefix }}efsat_engine_image_block(i), i, 0, 0);
  }
  return refused ? refused : {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, 36, image->height, links->height, links->height);
}

/* A coordinate of a triangle, in units of the format. */
static inline int64_t {{ h.prefix }}efsat_engine_image_coordinate(const struct {{ h.prefix }}efsat_engine_image *image, uint32_t place, unsigned i)
{
  return {{ h.prefix }}efsat_engine_image_signed(image->bytes + {{ h.prefix }}efsat_engine_image_triangle(image, place), {{ h.upper }}_TRIANGLE_STEP * (1 + i), {{ h.upper }}_TRANSFORM_BITS);
}

/* Whether the fields of a triangle are such as the format has. */
static inline int {{ h.prefix }}efsat_engine_check_triangle(const struct {{ h.prefix }}efsat_engine_image *image, uint32_t place, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const uint64_t at = {{ h.prefix }}efsat_engine_image_triangle(image, place);
  const uint8_t *const triangle = image->bytes + at;
  int refused = 0;
  for (unsigned i = 0; i < 9 && !refused; i++)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t)at, {{ h.prefix }}efsat_engine_image_coordinate(image, place, i), -{{ h.upper }}_TRIANGLE_ONE, {{ h.upper }}_TRIANGLE_ONE);
  for (unsigned i = 0; i < 9 && !refused; i++) {
    const int64_t found = {{ h.prefix }}efsat_engine_image_signed(triangle, {{ h.upper }}_TRIANGLE_STEP * (1 + i), {{ h.upper }}_TRIANGLE_STEP), due = {{ h.prefix }}efsat_engine_image_coordinate(image, place, i);
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t)at, found, due, due);
  }
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_range(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t)at,
        {{ h.prefix }}efsat_engine_image_used(triangle, {{ h.upper }}_TRIANGLE_HEAD_BITS, {{ h.upper }}_TRIANGLE_STEP) ||
            {{ h.prefix }}efsat_engine_image_used(triangle, 10 * {{ h.upper }}_TRIANGLE_STEP, 8 * {{ h.upper }}_IMAGE_TRIANGLE_BYTES), 0, 0);
  return refused;
}

/* Whether each triangle has a number of its own, below that of triangles. */
static inline int {{ h.prefix }}efsat_engine_check_faces(const struct {{ h.prefix }}efsat_engine_image *image, uint32_t *seen, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  {{ h.prefix }}efsat_engine_image_forget(seen, image->triangles);
  for (uint32_t i = 0; i < image->triangles; i++) {
    const uint32_t face = {{ h.prefix }}efsat_engine_image_face(image, i);
    if (face >= image->triangles || !{{ h.prefix }}efsat_engine_image_take(seen, face))
      return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_IMAGE_FIELD, (uint32_t){{ h.prefix }}efsat_engine_image_triangle(image, i), face, 0, (int64_t)image->triangles - 1);
  }
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}

/* How far a triangle surely reaches along each direction, in the finer of its units and those of the grid. */
static inline void {{ h.prefix }}efsat_engine_image_reach(int64_t reach[{{ h.upper }}_IMAGE_DIRECTIONS], const struct {{ h.prefix }}efsat_engine_image *image, uint32_t place)
{
  for (unsigned direction = 0; direction < {{ h.upper }}_IMAGE_DIRECTIONS; direction++)
    for (unsigned corner = 0; corner < 3; corner++) {
      int64_t along = 0;
      for (unsigned axis = 0; axis < 3; axis++) {
        const int n = {{ h.prefix }}efsat_engine_direction[direction][axis];
        const unsigned i = 3 * corner + axis;
{%- if h.is_sticky %}
        const int64_t above = (int64_t){{ h.prefix }}efsat_engine_image_field(image->bytes + {{ h.prefix }}efsat_engine_image_triangle(image, place), {{ h.upper }}_IMAGE_FACE_BITS + i, 1);
{%- else %}
        const int64_t above = 1;
{%- endif %}
        along += n * ({{ h.prefix }}efsat_engine_image_coordinate(image, place, i) + (n < 0 ? above : 0));
      }
      along *= INT64_C(1) << {{ h.upper }}_REACH_SHIFT;
      if (corner == 0 || along > reach[direction])
        reach[direction] = along;
    }
}

/* Whether the codes of a child, named as by a link, hold what reaches so far. */
static inline int {{ h.prefix }}efsat_engine_image_holds(const struct {{ h.prefix }}efsat_engine_image *image, uint32_t link, const int64_t reach[{{ h.upper }}_IMAGE_DIRECTIONS])
{
  const uint8_t *const block = image->bytes + {{ h.prefix }}efsat_engine_image_block(link / 2);
  const unsigned exponent = (unsigned){{ h.prefix }}efsat_engine_image_field(block, {{ h.upper }}_BLOCK_EXPONENT_LOW, 4);
  for (unsigned i = 0; i < {{ h.upper }}_IMAGE_DIRECTIONS; i++) {
    const unsigned at = {{ h.upper }}_BLOCK_CODES_LOW + {{ h.upper }}_BLOCK_CODE_BITS * ({{ h.upper }}_IMAGE_DIRECTIONS * (link % 2) + i);
    int64_t origin = 0, held;
    for (unsigned axis = 0; axis < 3; axis++)
      origin += {{ h.prefix }}efsat_engine_direction[i][axis] * {{ h.prefix }}efsat_engine_image_signed(block, 64 + axis * {{ h.upper }}_BLOCK_ORIGIN_BITS, {{ h.upper }}_BLOCK_ORIGIN_BITS);
    held = {{ h.prefix }}efsat_engine_image_signed(block, at, {{ h.upper }}_BLOCK_CODE_BITS) * (INT64_C(1) << exponent) + origin * (INT64_C(1) << {{ h.upper }}_ORIGIN_SHIFT);
    if (held * (INT64_C(1) << {{ h.upper }}_HELD_SHIFT) < reach[i])
      return 0;
  }
  return 1;
}

/* Whether every code holds the triangles below it; else the last block of which one does not. */
static inline int {{ h.prefix }}efsat_engine_check_codes(const struct {{ h.prefix }}efsat_engine_image *image, const struct {{ h.prefix }}efsat_engine_links *links, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  int64_t reach[{{ h.upper }}_IMAGE_DIRECTIONS];
  uint32_t wrong = UINT32_MAX;
  for (uint32_t i = 0; i < 2 * image->blocks; i++) {
    const uint32_t link = (uint32_t){{ h.prefix }}efsat_engine_image_field(image->bytes + {{ h.prefix }}efsat_engine_image_block(i / 2), 32 * (i % 2), 32);
    if (link == UINT32_MAX || !(link >> 31))
      continue;
    {{ h.prefix }}efsat_engine_image_reach(reach, image, link & INT32_MAX);
    for (uint32_t up = i; up != UINT32_MAX; up = links->from[up / 2])
      if (!{{ h.prefix }}efsat_engine_image_holds(image, up, reach) && (wrong == UINT32_MAX || up / 2 > wrong))
        wrong = up / 2;
  }
  if (wrong != UINT32_MAX)
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_IMAGE_CODE, (uint32_t){{ h.prefix }}efsat_engine_image_block(wrong), wrong, 0, 0);
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}

/* Checks all of an image whose header was read: each field, that its blocks are one tree over all triangles, that each of these has a
 * number of its own, and that no code excludes a triangle as it is stored. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_check_image(const struct {{ h.prefix }}efsat_engine_image *image, uint32_t *scratch, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  struct {{ h.prefix }}efsat_engine_links links;
  int refused;
  links.from = scratch;
  links.level = scratch + image->blocks;
  links.seen = scratch + 2 * (size_t)image->blocks;
  refused = {{ h.prefix }}efsat_engine_check_tree(image, &links, why);
  for (uint32_t i = 0; i < image->triangles && !refused; i++)
    refused = {{ h.prefix }}efsat_engine_check_triangle(image, i, why);
  if (!refused)
    refused = {{ h.prefix }}efsat_engine_check_faces(image, links.seen, why);
  return refused ? refused : {{ h.prefix }}efsat_engine_check_codes(image, &links, why);
}

#endif

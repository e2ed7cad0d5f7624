/* Where the triangles of an object are in memory: an address in bytes, a multiple of 64, and how many there are. */
struct {{ h.prefix }}efsat_engine_side {
  uint64_t triangles_at;
  uint32_t triangles;
};

/* What pairs have in common: A and B, `flags`, an OR of {{ h.upper }}_ALL_PAIRS and {{ h.upper }}_KEEP_CACHES, and the pose
 * m00 m01 m02 m10 ... m22 t_x t_y t_z in units of 2^({{ h.upper }}_INTEGRAL_BITS - {{ h.upper }}_TRANSFORM_BITS); if `as_it_lies` is
 * set, B is not moved. Without {{ h.upper }}_KEEP_CACHES the engine reads again what the packet needs; with it the answer is right only
 * if no image has been written to since the last packet without it.
{%- if h.is_sticky %} Bit i of `sticky` is set if number i is greater than its lower bound.{% endif %} */
struct {{ h.prefix }}efsat_engine_head {
  struct {{ h.prefix }}efsat_engine_side sides[2];
  uint32_t flags;
  int as_it_lies;
  int64_t pose[12];
{%- if h.is_sticky %}
  uint32_t sticky;
{%- endif %}
};

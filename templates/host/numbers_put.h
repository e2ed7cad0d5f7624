/* The first {{ h.upper }}_PAIRS_WORD words of a packet; a word for each pair follows, as `{{ h.prefix }}efsat_engine_put_pair` gives it. The
 * packet gets the number `*next`, which then is the next one; begin with any. The report of its answer has to return it. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_put_head(uint64_t packet[{{ h.upper }}_PAIRS_WORD], const struct {{ h.prefix }}efsat_engine_head *head,
    uint32_t *next, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const struct {{ h.prefix }}efsat_engine_side *a = &head->sides[0], *b = &head->sides[1];
  const uint32_t known = {{ h.upper }}_ALL_PAIRS | {{ h.upper }}_KEEP_CACHES;
  uint64_t *word = packet;
  int refused = head->flags & ~known ? {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_FLAGS, {{ h.upper }}_NO_INDEX, head->flags, 0, known) : 0;
  for (unsigned i = 0; i < 2 && !refused; i++) {
    const uint64_t address = head->sides[i].triangles_at;
    if (address % 64 || address >> 38)
      refused = {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_ADDRESS, i, (int64_t)address, 0, (INT64_C(1) << 38) - 64);
  }
  if (!refused && !head->as_it_lies)
    refused = {{ h.prefix }}efsat_engine_check_pose(head->pose{% if h.is_sticky %}, head->sticky{% endif %}, why);
  if (refused)
    return refused;
  *next &= (UINT32_C(1) << {{ h.upper }}_QUERY_NUMBER_BITS) - 1;
  *word++ = (uint64_t)*next << {{ h.upper }}_QUERY_NUMBER_LOW | {{ h.prefix }}efsat_engine_both({{ h.upper }}_NUMBERS_HEADER, head->flags);
  ++*next;
  *word++ = {{ h.prefix }}efsat_engine_both(a->triangles_at / 64, b->triangles_at / 64);
  *word++ = {{ h.prefix }}efsat_engine_both(a->triangles, b->triangles);
  *word++ = {% if h.is_sticky %}head->sticky | {% endif %}(head->as_it_lies ? UINT64_C(1) << 31 : 0);
  for (unsigned i = 0; i < 12; i += 2)
    *word++ = head->as_it_lies ? 0 : {{ h.prefix }}efsat_engine_both((uint64_t)head->pose[i], (uint64_t)head->pose[i + 1]);
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}

/* The word of a pair behind the head of its packet: the places of the triangles in the images of A and of B. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_put_pair(uint64_t *word, const uint64_t packet[{{ h.upper }}_PAIRS_WORD], uint32_t a, uint32_t b,
    struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const uint64_t counts = packet[{{ h.upper }}_TRIANGLES_WORD];
  if (a >= (counts & UINT32_MAX) || b >= counts >> 32)
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_TRIANGLE, a >= (counts & UINT32_MAX) ? 0 : 1, a >= (counts & UINT32_MAX) ? a : b, 0,
        (int64_t)(a >= (counts & UINT32_MAX) ? counts & UINT32_MAX : counts >> 32) - 1);
  *word = {{ h.prefix }}efsat_engine_both(a, b);
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}

/* All words of the answer to a packet of `asked` pairs: words of pairs in their order, and the report, which is copied. `faces[0]` and
 * `faces[1]`, if `faces` is not null, have the face of each triangle of A and of B by its place in the image; then pairs in another order
 * are refused. So is an answer that is not that of this packet, or that the engine cannot have given: a report of another packet, words
 * that are no pairs, other pairs than the report counts. Of an incomplete answer the pairs are not looked at. */
{{ h.upper }}_CHECKED static inline int {{ h.prefix }}efsat_engine_get_answer(struct {{ h.prefix }}efsat_engine_report *report, const uint64_t *packet, size_t asked,
    const uint32_t *const faces[2], const uint64_t *words, size_t count, struct {{ h.prefix }}efsat_engine_refusal *why)
{
  const uint64_t number = packet[0] >> {{ h.upper }}_QUERY_NUMBER_LOW, counts = packet[{{ h.upper }}_TRIANGLES_WORD];
  const uint32_t flags = (uint32_t)(packet[0] >> 32) & {{ h.upper }}_ALL_PAIRS;
  const size_t pairs = count < {{ h.upper }}_REPORT_WORDS ? 0 : count - {{ h.upper }}_REPORT_WORDS;
  const uint64_t *last = words + pairs;
  int64_t found[3] = {0, 0, 0};
  size_t place = 0;
  if (count < {{ h.upper }}_REPORT_WORDS || (last[0] & 3) != {{ h.upper }}_VERDICT_REPORT)
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_NO_REPORT, {{ h.upper }}_NO_INDEX, (int64_t)count, 0, 0);
  *report = {{ h.prefix }}efsat_engine_get_report(last);
  if (report->reason > {{ h.upper }}_REASON_RESET || report->incomplete != (report->reason != {{ h.upper }}_REASON_COMPLETE))
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_NO_REPORT, {{ h.upper }}_NO_INDEX, (int64_t)count, 0, 0);
  /* The report of a packet that was not read has no number, that of a soft reset one of its own. */
  if (report->number != number && (report->reason < {{ h.upper }}_REASON_UNKNOWN_HEADER || report->reason == {{ h.upper }}_REASON_SILENT))
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_ANSWER_NUMBER, {{ h.upper }}_NO_INDEX, report->number, (int64_t)number, (int64_t)number);
  if (report->incomplete)
    return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
  for (size_t i = 0; i < pairs; i++) {
    const struct {{ h.prefix }}efsat_engine_pair pair = {{ h.prefix }}efsat_engine_get_pair(words[i]);
    int there = !(words[i] >> 2 & 63) && pair.verdict != {{ h.upper }}_VERDICT_REPORT && pair.a < (counts & UINT32_MAX) && pair.b < counts >> 32
        && (pair.verdict != {{ h.upper }}_VERDICT_SEPARATE || flags);
    if (there && faces) {
      /* The next of the pairs asked for that has these faces. */
      const uint64_t *named = packet + {{ h.upper }}_PAIRS_WORD;
      while (place < asked && (faces[0][named[place] & UINT32_MAX] != pair.a || faces[1][named[place] >> 32] != pair.b))
        place++;
      there = place++ < asked;
    }
    if (!there)
      return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_PAIR, (uint32_t)i, (int64_t)words[i], 0, 0);
    found[pair.verdict]++;
  }
  if ({{ h.prefix }}efsat_engine_check_counts(found, report, why))
    return {{ h.upper }}_REFUSED_COUNT;
  /* All pairs are tested, and answered if all were asked for. */
  if (report->leaf_pairs != asked || (flags && pairs != asked))
    return {{ h.prefix }}efsat_engine_refuse(why, {{ h.upper }}_REFUSED_COUNT, {{ h.upper }}_NO_INDEX, flags ? (int64_t)pairs : (int64_t)report->leaf_pairs, (int64_t)asked,
        (int64_t)asked);
  return {{ h.prefix }}efsat_engine_refuse(why, 0, 0, 0, 0, 0);
}

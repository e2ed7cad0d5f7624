def answer(data, packet, faces=None):
    """The Pairs, in their order, and the Report of the bytes that came back for one packet.

    An answer is refused that is not the answer to it: a report of another packet, words that are no pairs, other pairs than the report
    counts. `faces` are two lists, the face of each triangle of A and of B by its place in the image; with them pairs in another order
    are refused, too. The pairs of an incomplete answer are the first ones, and are not compared with anything.
    """
    words, asked = _words(data), _words(packet)
    if len(words) < REPORT_WORDS or words[-REPORT_WORDS] & 3 != VERDICT_REPORT:
        raise ValueError(f"found {len(words)} words; expected a report in the last {REPORT_WORDS}")
    report = _report(words[-REPORT_WORDS:])
    pairs = [_pair(i, word) for i, word in enumerate(words[:-REPORT_WORDS])]
    number, all_pairs, counts = asked[0] >> QUERY_NUMBER_LOW, asked[0] >> 32 & ALL_PAIRS, asked[TRIANGLES_WORD]
    # The report of a packet that was not read has no number.
    if report.number != number and (report.reason < REASON_UNKNOWN_HEADER or report.reason == REASON_SILENT):
        raise ValueError(f"found the report of packet {report.number}; expected that of packet {number}")
    if report.incomplete:
        return pairs, report
    named = iter(asked[PAIRS_WORD:])
    for i, pair in enumerate(pairs):
        if pair.a >= counts % (1 << 32) or pair.b >= counts >> 32:
            raise ValueError(f"pair {i}: found triangles {pair.a} and {pair.b}; expected such as the objects have")
        if pair.verdict == VERDICT_SEPARATE and not all_pairs:
            raise ValueError(f"pair {i}: found a separate pair; expected none, because none was asked for")
        if faces and not any((faces[0][word % (1 << 32)], faces[1][word >> 32]) == pair[1:] for word in named):
            raise ValueError(f"pair {i}: found triangles {pair.a} and {pair.b}; expected the pairs in their order")
    count = len(asked) - PAIRS_WORD
    for what, found, due in [
        ("pairs that intersect", sum(pair.verdict == VERDICT_INTERSECT for pair in pairs), report.intersect),
        ("possibly incorrect pairs", sum(pair.verdict == VERDICT_POSSIBLY_INCORRECT for pair in pairs), report.possibly_incorrect),
        ("pairs tested", report.leaf_pairs, count),
        ("pairs", len(pairs) if all_pairs else count, count),
    ]:
        if found != due:
            raise ValueError(f"found {found} {what}; expected {due}")
    return pairs, report

def pairs(sides, pairs, pose=None, flags=0, number=None{% if h.is_sticky %}, sticky=0{% endif %}):
    """The packet of pairs by number: two Sides, and the places of the triangles of each pair in the images of A and of B.

    `pose` is m00 m01 m02 m10 ... m22 t_x t_y t_z; without it B is not moved. `flags` is an OR of ALL_PAIRS and KEEP_CACHES. `number`
    returns in the report; without it each packet gets the next one. Without KEEP_CACHES the engine reads again what the packet needs;
    with it the answer is right only if no image has been written to since the last packet without it.
{%- if h.is_sticky %}
    Bit i of `sticky`: number i is greater than its lower bound.
{%- endif %}
    """
    sides = _all("sides", sides, 2)
    flags = _field("flags", flags, 32)
    if flags & ~(ALL_PAIRS | KEEP_CACHES):
        raise ValueError(f"flags: found {flags:#x}; expected an OR of ALL_PAIRS and KEEP_CACHES")
    if number is None:
        number = next(_numbers) % (1 << QUERY_NUMBER_BITS)
{%- if h.is_sticky %}
    sticky = _field("sticky", sticky, 12)
{%- endif %}
    if pose is None:
        record = [{% if h.is_sticky %}sticky | {% endif %}1 << 31] + [0] * 6
    else:
        ranges = [("entry of M", ENTRY_LEAST, ENTRY_MOST)] * 9 + [("entry of t", TRANSLATION_LEAST, TRANSLATION_MOST)] * 3
        low = [
            _whole(f"{what} {i}", x, least, most{% if h.is_sticky %} - (sticky >> i & 1){% endif %}) % (1 << 32)
            for i, (x, (what, least, most)) in enumerate(zip(_all("numbers of the pose", pose, 12), ranges))
        ]
        record = [{% if h.is_sticky %}sticky{% else %}0{% endif %}, *(_both("pose", *low[i : i + 2]) for i in range(0, 12, 2))]
    named = [
        _both("triangle", *(_whole(f"triangle of pair {i}", place, 0, side.triangles - 1) for place, side in zip(_all(f"pair {i}", pair, 2), sides)))
        for i, pair in enumerate(pairs)
    ]
    return _bytes(
        [
            _both("header", NUMBERS_HEADER, flags) | _field("number", number, QUERY_NUMBER_BITS) << QUERY_NUMBER_LOW,
            _both("address", *(_address(f"address of side {i}", side.triangles_at) for i, side in enumerate(sides))),
            _both("number of triangles", *(side.triangles for side in sides)),
            *record,
            *named,
        ]
    )

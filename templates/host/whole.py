def _whole(what, value, least, most):
    """A whole number of any kind, Python's or another's, inside its range; nothing is rounded or cut."""
    try:
        whole = operator.index(value)
    except TypeError:
        raise TypeError(f"{what}: found {value!r}; expected a whole number, {least} to {most}") from None
    if not least <= whole <= most:
        raise ValueError(f"{what}: found {whole}; expected {least} to {most}")
    return whole


def _all(what, values, count):
    """So many values."""
    values = list(values)
    if len(values) != count:
        raise ValueError(f"{what}: found {len(values)}; expected {count}")
    return values

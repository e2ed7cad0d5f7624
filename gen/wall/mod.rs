//! Wall maps: verdicts around a contact, one vertex moved over a grid of single units in the last place.

(** What the main theorems rest on. Those over the integers rest on nothing; those over the real numbers on the two axioms of the
    standard library's reals, and on no other. *)
Require Import Efsat.Domain Efsat.Axes Efsat.Verdict Efsat.RealSpace Efsat.Determinants Efsat.DeterminantUnit.
Require Efsat.AxisUnit Efsat.AxisRanges Efsat.Cascade Efsat.Hierarchy Efsat.Stack Efsat.Certificate Efsat.Refuted Efsat.Compare.

Definition over_integers := (
  OnIntegers.A.E.exact_right,
  OnIntegers.A.K.crosses_right,
  OnIntegers.A.eleven_axes,
  OnIntegers.A.two_hit,
  OnIntegers.separate_sound,
  OnIntegers.intersect_sound,
  AxisRanges.guard_keeps,
  AxisRanges.guard_replaces,
  AxisRanges.shifted_axis_fits,
  AxisRanges.normalised_fits,
  Hierarchy.no_pair_is_lost,
  Stack.stack_never_overflows,
  Stack.never_stuck,
  Stack.all_are_sent,
  Stack.no_query_loses_a_pair,
  Certificate.certified,
  Refuted.four_missed_edges,
  Refuted.weak_eleven_axes,
  Refuted.only_piercing_edges,
  Refuted.boxes_that_touch,
  Refuted.mute).
Print Assumptions over_integers.

Definition over_real_numbers := (
  exact_unit_is_right,
  exact_crossing_is_right,
  errors,
  sign_certain,
  determinant_unit_is_right,
  AxisRanges.axis_unit_is_right,
  AxisRanges.kept_words_are_declared,
  Cascade.cascade_is_right,
  Hierarchy.one_row_serves_two_directions,
  Hierarchy.host_error_is_enough,
  Hierarchy.touching_volumes_are_not_apart,
  Refuted.face_three_times,
  Refuted.words_stand,
  Refuted.gap_of_one).
Print Assumptions over_real_numbers.

(** What the theorems rest on. The statements over the integers rest on nothing; those over the real numbers on the two axioms of
    the standard library's reals, and on no other. *)
Require Import Efsat.Domain Efsat.Axes Efsat.Verdict Efsat.RealSpace Efsat.Determinants Efsat.DeterminantUnit.
Require Efsat.AxisUnit Efsat.AxisRanges Efsat.Cascade Efsat.Hierarchy Efsat.Refuted Efsat.Compare.

(* Integers. *)
Print Assumptions OnIntegers.A.E.exact_right.
Print Assumptions OnIntegers.A.eleven_axes.
Print Assumptions OnIntegers.A.two_hit.
Print Assumptions OnIntegers.separate_sound.
Print Assumptions OnIntegers.intersect_sound.
Print Assumptions AxisRanges.guard_keeps.
Print Assumptions Hierarchy.no_pair_is_lost.
Print Assumptions Refuted.four_missed_edges.
Print Assumptions Refuted.weak_eleven_axes.
Print Assumptions Refuted.only_piercing_edges.
Print Assumptions Refuted.mute.
(* Real numbers. *)
Print Assumptions exact_unit_is_right.
Print Assumptions errors.
Print Assumptions determinant_unit_is_right.
Print Assumptions AxisRanges.axis_unit_is_right.
Print Assumptions AxisRanges.kept_words_are_declared.
Print Assumptions Cascade.cascade_is_right.
Print Assumptions Hierarchy.touching_volumes_are_not_apart.
Print Assumptions Refuted.face_three_times.
Print Assumptions Refuted.gap_of_one.

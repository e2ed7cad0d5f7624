(** The cascade: docs/cascade.md. Two stages decide every pair that fits: the determinant unit of 18 bits first, on differences
    with 20 places below the grid, and the exact unit if that leaves the pair open.

    A pair that fits is answered `separate` if and only if its closed triangles have no common point, and `intersect` if and only
    if they have one: [cascade_is_right]. So the answer is that of the exact unit for every pair. *)
From Coq Require Import ZArith Reals Lra Lia List Bool.
Require Import Efsat.Sign Efsat.Domain Efsat.Triple Efsat.RealSpace Efsat.Vectors Efsat.Determinants Efsat.DeterminantUnit.
Import ListNotations.
Local Open Scope Z_scope.

(** 18 bits, `--transform off`, `--levels 0`, other options at their defaults. *)
Definition first_stage := Options 18 28 Off 3 3 2 1 Norms true.
Definition below (v : zvec) := Z3 (ZX v * 2 ^ 20) (ZY v * 2 ^ 20) (ZZ v * 2 ^ 20).
Definition scaled x := Points (below (V1 x)) (below (V2 x)) (tab (fun l => below (W x l))).
Definition on_grid (v : zvec) := I.S.V3 (ZX v) (ZY v) (ZZ v).
Definition second x := if I.separate (on_grid (V1 x)) (on_grid (V2 x)) (on_grid (W x T0)) (on_grid (W x T1)) (on_grid (W x T2)) then Separate else Intersect.
Definition cascade x := match verdict (outcome_of (of_differences first_stage (scaled x))) with Unknown => second x | decided => decided end.

Theorem cascade_is_right x : let at_ v := RealSpace.of_grid (on_grid v) in
  let meets := common (0, 0, 0)%R (at_ (V1 x)) (at_ (V2 x)) (at_ (W x T0)) (at_ (W x T1)) (at_ (W x T2)) in
  (cascade x = Separate <-> ~ meets) /\ (cascade x = Intersect <-> meets).
Proof.
  intros at_ meets.
  assert (S : (second x = Separate -> ~ meets) /\ (second x = Intersect -> meets) /\ second x <> Unknown).
  { pose proof (exact_unit_is_right I.S.origin (on_grid (V1 x)) (on_grid (V2 x)) (on_grid (W x T0)) (on_grid (W x T1)) (on_grid (W x T2))) as K.
    unfold I.exact_separate in K.
    assert (E : forall v, I.S.minus (on_grid v) I.S.origin = on_grid v).
    { intros [a b d]. unfold I.S.minus, on_grid, I.S.origin, Integers.sub, Integers.zero. cbn. now rewrite !Z.sub_0_r. }
    rewrite !E in K. change (of_grid I.S.origin) with (0, 0, 0)%R in K. fold meets in K. unfold second.
    destruct (I.separate _ _ _ _ _); repeat split; try discriminate; intros _; [intros M; apply K in M; discriminate|now apply K]. }
  assert (F : says (verdict (outcome_of (of_differences first_stage (scaled x)))) meets).
  { set (K := IZR (2 ^ 20)).
    assert (D := differences_right first_stage (scaled x) (real (below (V1 x))) (real (below (V2 x))) (fun l => real (below (W x l))) 0 eq_refl).
    assert (Q : forall v, close 0 v (real v)) by (intros v; unfold close, real; cbn; unfold Rminus; rewrite !Rplus_opp_r, Rabs_R0; lra).
    specialize (D ltac:(cbn; lra) ltac:(cbn; lra) (Q _) (Q _)).
    assert (QW : forall l, close 0 (W (scaled x) l) (real (below (W x l)))) by (intros []; apply Q). specialize (D QW). clear Q QW.
    assert (T : forall v, there (real (below v)) = stretched K K K (there (real v))).
    { intros [a b d]. unfold there, stretched, real, below, K. cbn -[Z.pow]. rewrite !mult_IZR. f_equal; ring. }
    rewrite !T in D. replace R.S.origin with (stretched K K K R.S.origin) in D by (unfold stretched, R.S.origin, RealNumbers.zero; cbn; f_equal; ring).
    assert (NK : (K <> 0)%R) by (unfold K; apply not_0_IZR; discriminate).
    unfold says in *. rewrite (meet_stretched K K K _ _ _ _ _ _ NK NK NK), meet_common in D. exact D. }
  unfold cascade. destruct S as (S1 & S2 & S3), F as [F1 F2].
  destruct (verdict (outcome_of (of_differences first_stage (scaled x)))) eqn:V.
  - specialize (F1 eq_refl). repeat split; intros; try discriminate; tauto.
  - specialize (F2 eq_refl). repeat split; intros; try discriminate; tauto.
  - destruct (second x) eqn:X; [specialize (S1 eq_refl)|specialize (S2 eq_refl)|tauto]; repeat split; intros; try discriminate; tauto.
Qed.

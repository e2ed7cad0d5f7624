(** From integers to real space: the exact unit says `separate` if and only if the closed triangles, as sets of points of real space,
    have no common point ([exact_unit_is_right]), and *crosses* if and only if their relative interiors have one
    ([exact_crossing_is_right]). For real numbers, weights and sets of points say the same ([meet_common]). *)
From Coq Require Import List Bool PArith ZArith Reals Lra Lia.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.PlaneTable Efsat.Space Efsat.Plane Efsat.Exact Efsat.CrossTable Efsat.Crosses Efsat.Axes Efsat.Verdict.
Import ListNotations.
Module IK := OnIntegers.A.K. Module RK := OnReals.A.K. Module I := IK.E. Module R := RK.E.

Definition real (v : I.S.vec) : R.S.vec := R.S.V3 (IZR (I.S.X v)) (IZR (I.S.Y v)) (IZR (I.S.Z v)).
Lemma sg_IZR x : RealNumbers.sg (IZR x) = Integers.sg x.
Proof.
  destruct (Integers.sg x) eqn:E.
  - apply Integers.sg_N in E. apply RealNumbers.sg_N. now apply IZR_lt.
  - apply Integers.sg_zero in E. rewrite E. now apply RealNumbers.sg_zero.
  - apply Integers.sg_P in E. apply RealNumbers.sg_P. now apply IZR_lt.
Qed.
Ltac push := unfold Integers.add, Integers.sub, Integers.mul, Integers.opp, Integers.zero, Integers.one,
  RealNumbers.add, RealNumbers.sub, RealNumbers.mul, RealNumbers.opp, RealNumbers.zero, RealNumbers.one in *;
  rewrite ?plus_IZR, ?minus_IZR, ?mult_IZR, ?opp_IZR, ?plus_IZR, ?minus_IZR, ?mult_IZR, ?opp_IZR.
Lemma real_minus u v : real (I.S.minus u v) = R.S.minus (real u) (real v).
Proof. unfold real, R.S.minus; cbn. push. reflexivity. Qed.
Lemma real_cross u v : real (I.S.cross u v) = R.S.cross (real u) (real v).
Proof. unfold real, R.S.cross; cbn. push. reflexivity. Qed.
Lemma real_dot u v : IZR (I.S.dot u v) = R.S.dot (real u) (real v).
Proof. unfold R.S.dot, I.S.dot; cbn. push. reflexivity. Qed.
Lemma real_fifteen v1 v2 w0 w1 w2 : map IZR (I.S.fifteen v1 v2 w0 w1 w2) = R.S.fifteen (real v1) (real v2) (real w0) (real w1) (real w2).
Proof. unfold I.S.fifteen, R.S.fifteen. cbn [map]. push. rewrite !real_dot, !real_cross. reflexivity. Qed.
Lemma real_sign v1 v2 w0 w1 w2 v : R.S.sign_of (R.S.fifteen (real v1) (real v2) (real w0) (real w1) (real w2)) v = I.S.sign_of (I.S.fifteen v1 v2 w0 w1 w2) v.
Proof. unfold R.S.sign_of, I.S.sign_of, R.S.pick, I.S.pick. rewrite <- real_fifteen, <- sg_IZR. change RealNumbers.zero with (IZR 0). now rewrite map_nth. Qed.
Lemma real_below a b : R.below (map IZR a) (map IZR b) = I.below a b.
Proof.
  unfold R.below, I.below. induction a as [|x a IH]; cbn; auto. rewrite IH. f_equal. clear IH.
  induction b as [|y b IH]; cbn; auto. rewrite IH. f_equal. f_equal. rewrite <- sg_IZR. push. reflexivity.
Qed.
Lemma real_apart a b : R.apart (map IZR a) (map IZR b) = I.apart a b.
Proof. unfold R.apart, I.apart. now rewrite !real_below. Qed.
Lemma real_zero v : R.zero_vec (real v) = I.zero_vec v.
Proof. unfold R.zero_vec, I.zero_vec, real. cbn. now rewrite !sg_IZR. Qed.
Lemma real_origin : R.S.origin = real I.S.origin.
Proof. reflexivity. Qed.
Lemma real_first vs : R.first_of (map real vs) = real (I.first_of vs).
Proof. unfold R.first_of, I.first_of. induction vs as [|v vs IH]; cbn; [reflexivity|]. rewrite real_zero. destruct (I.zero_vec v); cbn; auto. Qed.
Lemma real_boxes v1 v2 w0 w1 w2 : R.boxes_apart (real v1) (real v2) (real w0) (real w1) (real w2) = I.boxes_apart v1 v2 w0 w1 w2.
Proof. unfold R.boxes_apart, I.boxes_apart. cbn [existsb]. rewrite <- !real_apart. reflexivity. Qed.
Lemma real_moment v1 v2 w0 w1 w2 cr ci : (forall v, cr (real v) = IZR (ci v)) -> R.some_moment (real v1) (real v2) (real w0) (real w1) (real w2) cr = I.some_moment v1 v2 w0 w1 w2 ci.
Proof. intros H. unfold R.some_moment, I.some_moment, R.moments, I.moments. cbn [existsb]. now rewrite <- !real_cross, !H, !sg_IZR. Qed.
Definition real2 (p : I.L.point) : R.L.point := (IZR (fst p), IZR (snd p)).
Lemma real_twenty p0 p1 p2 p3 p4 p5 : map IZR (I.L.twenty p0 p1 p2 p3 p4 p5) = R.L.twenty (real2 p0) (real2 p1) (real2 p2) (real2 p3) (real2 p4) (real2 p5).
Proof. unfold I.L.twenty, R.L.twenty, I.L.orient, R.L.orient, real2. cbn [map fst snd]. push. reflexivity. Qed.
Lemma real_plane_sign p0 p1 p2 p3 p4 p5 v : R.L.plane_sign (real2 p0) (real2 p1) (real2 p2) (real2 p3) (real2 p4) (real2 p5) v = I.L.plane_sign p0 p1 p2 p3 p4 p5 v.
Proof. unfold R.L.plane_sign, I.L.plane_sign, R.L.get, I.L.get. rewrite <- real_twenty, <- sg_IZR. change RealNumbers.zero with (IZR 0). now rewrite map_nth. Qed.
Lemma parts_ext f g e : (forall v, f v = g v) -> parts_edge f e = parts_edge g e.
Proof. intros H. destruct e as [[[[b0 v0] [b1 v1]] [b2 v2]] [b v]]. cbn. now rewrite !H. Qed.
Lemma existsb_ext {A} (f g : A -> bool) l : (forall x, f x = g x) -> existsb f l = existsb g l.
Proof. intros H. induction l; cbn; auto. now rewrite H, IHl. Qed.
Lemma forallb_ext {A} (f g : A -> bool) l : (forall x, f x = g x) -> forallb f l = forallb g l.
Proof. intros H. induction l; cbn; auto. now rewrite H, IHl. Qed.
Lemma real_parted v1 v2 w0 w1 w2 ar ai : (forall v, ar (real v) = real2 (ai v)) -> R.parted (real v1) (real v2) (real w0) (real w1) (real w2) ar = I.parted v1 v2 w0 w1 w2 ai.
Proof. intros H. unfold R.parted, I.parted. apply existsb_ext. intros e. apply parts_ext. intros v. rewrite real_origin, !H. apply real_plane_sign. Qed.

Lemma real_separate v1 v2 w0 w1 w2 : R.separate (real v1) (real v2) (real w0) (real w1) (real w2) = I.separate v1 v2 w0 w1 w2.
Proof.
  unfold R.separate, I.separate.
  rewrite (forallb_ext _ (fun v => seq (I.S.sign_of (I.S.fifteen v1 v2 w0 w1 w2) v) O)) by (intros; now rewrite real_sign).
  rewrite (forallb_ext _ (fun v => seq (I.S.sign_of (I.S.fifteen v1 v2 w0 w1 w2) v) O) [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive) by (intros; now rewrite real_sign).
  rewrite (existsb_ext (R.S.hits_edge _) (I.S.hits_edge (I.S.sign_of (I.S.fifteen v1 v2 w0 w1 w2)))) by (intros [b [[[[p q] s0] s1] s2]]; cbn; now rewrite !real_sign).
  destruct (forallb _ [1; 2; 3; 4; 5; 6]%positive); auto. destruct (forallb _ [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive); auto.
  unfold R.in_plane, I.in_plane.
  rewrite !real_boxes, (real_moment _ _ _ _ _ _ I.S.X), (real_moment _ _ _ _ _ _ I.S.Y), (real_moment _ _ _ _ _ _ I.S.Z) by reflexivity.
  rewrite (real_parted _ _ _ _ _ _ I.along_x), (real_parted _ _ _ _ _ _ I.along_y), (real_parted _ _ _ _ _ _ I.along_z) by reflexivity.
  destruct (I.some_moment _ _ _ _ _ I.S.X); auto. destruct (I.some_moment _ _ _ _ _ I.S.Y); auto. destruct (I.some_moment _ _ _ _ _ I.S.Z); auto.
  change [real v1; real v2] with (map real [v1; v2]). change [real w0; real w1; real w2] with (map real [w0; w1; w2]).
  rewrite !real_first, <- real_cross, real_zero. destruct (I.zero_vec _); auto.
  cbn [existsb]. rewrite <- !real_apart. reflexivity.
Qed.

(** * The statement: closed triangles of the real space, as sets of points *)
Local Open Scope R_scope.
Definition point := (R * R * R)%type.
Definition of_grid (v : I.S.vec) : point := (IZR (I.S.X v), IZR (I.S.Y v), IZR (I.S.Z v)).
(** The convex hull of three points, which may coincide or lie on a line. *)
Definition in_triangle (a b c x : point) : Prop := exists l m n, 0 <= l /\ 0 <= m /\ 0 <= n /\ l + m + n = 1 /\
  let '(ax, ay, az) := a in let '(bx, by_, bz) := b in let '(cx, cy, cz) := c in
  x = (l * ax + m * bx + n * cx, l * ay + m * by_ + n * cy, l * az + m * bz + n * cz).

Lemma nonneg x : RealNumbers.sg x <> N <-> 0 <= x.
Proof. rewrite RealNumbers.sg_N. lra. Qed.

(** The points of real space with weights: what [meet] says is that the two triangles have a common point. *)
Definition place_of (v : R.S.vec) : point := (R.S.X v, R.S.Y v, R.S.Z v).
Definition common (a b c d e f : point) : Prop := exists x, in_triangle a b c x /\ in_triangle d e f x.
Theorem meet_common (a b c d e f : R.S.vec) :
  R.S.meet a b c d e f <-> common (place_of a) (place_of b) (place_of c) (place_of d) (place_of e) (place_of f).
Proof.
  unfold R.S.meet, R.S.meets_at, R.S.combine, common, place_of; cbn. split.
  - intros (x0 & x1 & x2 & x3 & x4 & x5 & H & S & G & K). repeat rewrite Forall_cons_iff in G. rewrite !nonneg in G.
    destruct G as (G0 & G1 & G2 & G3 & G4 & G5 & _). apply RealNumbers.sg_P in K. unfold RealNumbers.add, RealNumbers.mul in *.
    injection H as H1 H2 H3. set (t := x0 + x1 + x2) in *.
    assert (D : forall x, 0 <= x -> 0 <= x / t) by (intros; apply Rmult_le_pos; [auto|left; apply Rinv_0_lt_compat; auto]).
    exists ((x0 * R.S.X a + x1 * R.S.X b + x2 * R.S.X c) / t, (x0 * R.S.Y a + x1 * R.S.Y b + x2 * R.S.Y c) / t,
      (x0 * R.S.Z a + x1 * R.S.Z b + x2 * R.S.Z c) / t). split.
    + exists (x0 / t), (x1 / t), (x2 / t). repeat split; auto; [unfold t; field; fold t; lra|]. cbn. f_equal; [f_equal|]; field; lra.
    + exists (x3 / t), (x4 / t), (x5 / t). repeat split; auto; [rewrite S; field; lra|]. cbn. rewrite H1, H2, H3. f_equal; [f_equal|]; field; lra.
  - intros (x & (l & m & n & L0 & L1 & L2 & LS & LE) & (l' & m' & n' & L3 & L4 & L5 & LS' & LE')).
    exists l, m, n, l', m', n'. cbn in LE, LE'. rewrite LE in LE'. injection LE' as H1 H2 H3.
    unfold RealNumbers.add, RealNumbers.mul. repeat rewrite Forall_cons_iff. rewrite !nonneg, RealNumbers.sg_P.
    repeat split; try lra; [f_equal; assumption|constructor].
Qed.

(** Stretching the axes, each by its own factor, changes nothing. *)
Definition stretched (kx ky kz : R) (v : R.S.vec) : R.S.vec := R.S.V3 (kx * R.S.X v) (ky * R.S.Y v) (kz * R.S.Z v).
Lemma meet_stretched kx ky kz a b c d e f : kx <> 0 -> ky <> 0 -> kz <> 0 ->
  R.S.meet (stretched kx ky kz a) (stretched kx ky kz b) (stretched kx ky kz c) (stretched kx ky kz d) (stretched kx ky kz e) (stretched kx ky kz f)
    <-> R.S.meet a b c d e f.
Proof.
  intros KX KY KZ. unfold R.S.meet, R.S.meets_at, R.S.combine, stretched, RealNumbers.add, RealNumbers.mul; cbn.
  assert (T : forall k p q, k <> 0 -> k * p = k * q -> p = q) by (intros k p q K H; apply (Rmult_eq_reg_l k); auto).
  split; intros (x0 & x1 & x2 & x3 & x4 & x5 & H & S); exists x0, x1, x2, x3, x4, x5; (split; [|exact S]); injection H as H1 H2 H3; f_equal.
  - apply (T kx); auto. transitivity (x0 * (kx * R.S.X a) + x1 * (kx * R.S.X b) + x2 * (kx * R.S.X c)); [ring|]. rewrite H1. ring.
  - apply (T ky); auto. transitivity (x0 * (ky * R.S.Y a) + x1 * (ky * R.S.Y b) + x2 * (ky * R.S.Y c)); [ring|]. rewrite H2. ring.
  - apply (T kz); auto. transitivity (x0 * (kz * R.S.Z a) + x1 * (kz * R.S.Z b) + x2 * (kz * R.S.Z c)); [ring|]. rewrite H3. ring.
  - transitivity (kx * (x0 * R.S.X a + x1 * R.S.X b + x2 * R.S.X c)); [ring|]. rewrite H1. ring.
  - transitivity (ky * (x0 * R.S.Y a + x1 * R.S.Y b + x2 * R.S.Y c)); [ring|]. rewrite H2. ring.
  - transitivity (kz * (x0 * R.S.Z a + x1 * R.S.Z b + x2 * R.S.Z c)); [ring|]. rewrite H3. ring.
Qed.

(** * The theorem of the exact unit *)
Theorem exact_unit_is_right (a b c d e f : I.S.vec) :
  I.exact_separate a b c d e f = false <->
  common (of_grid a) (of_grid b) (of_grid c) (of_grid d) (of_grid e) (of_grid f).
Proof.
  assert (E : I.exact_separate a b c d e f = R.exact_separate (real a) (real b) (real c) (real d) (real e) (real f)).
  { unfold I.exact_separate, R.exact_separate. rewrite <- !real_minus. symmetry. apply real_separate. }
  rewrite E, R.exact_right. apply meet_common.
Qed.

(** * Crossing *)
Lemma real_nearly_apart a b : RK.nearly_apart (map IZR a) (map IZR b) = IK.nearly_apart a b.
Proof.
  assert (T : forall (g : sign -> bool) a b, forallb (fun x => forallb (fun y => g (RealNumbers.sg (RealNumbers.sub y x))) (map IZR b)) (map IZR a) =
    forallb (fun x => forallb (fun y => g (Integers.sg (Integers.sub y x))) b) a).
  { intros g c d. induction c as [|x c IH]; cbn; auto. rewrite IH. f_equal. clear IH. induction d as [|y d IH]; cbn; auto. rewrite IH. f_equal. f_equal.
    rewrite <- sg_IZR. push. reflexivity. }
  unfold RK.nearly_apart, IK.nearly_apart, RK.nearly_below, IK.nearly_below, RK.level, IK.level.
  now rewrite !(T (fun s => negb (seq s N))), (T (fun s => seq s O)).
Qed.
Lemma real_boxes_nearly v1 v2 w0 w1 w2 : RK.boxes_nearly_apart (real v1) (real v2) (real w0) (real w1) (real w2) = IK.boxes_nearly_apart v1 v2 w0 w1 w2.
Proof. unfold RK.boxes_nearly_apart, IK.boxes_nearly_apart. cbn [existsb]. rewrite <- !real_nearly_apart. reflexivity. Qed.
Lemma real_nearly_parted v1 v2 w0 w1 w2 ar ai : (forall v, ar (real v) = real2 (ai v)) ->
  RK.nearly_parted (real v1) (real v2) (real w0) (real w1) (real w2) ar = IK.nearly_parted v1 v2 w0 w1 w2 ai.
Proof.
  intros H. unfold RK.nearly_parted, IK.nearly_parted. apply existsb_ext. intros [[[[b0 u0] [b1 u1]] [b2 u2]] [b u]]. cbn. rewrite real_origin, !H, !real_plane_sign. reflexivity.
Qed.
Lemma real_straddle a : RK.straddle (map IZR a) = IK.straddle a.
Proof.
  assert (T : forall t, existsb (fun x => seq (RealNumbers.sg x) t) (map IZR a) = existsb (fun x => seq (Integers.sg x) t) a).
  { intros t. induction a as [|x a IH]; cbn; [reflexivity|]. now rewrite IH, sg_IZR. }
  unfold RK.straddle, IK.straddle. now rewrite !T.
Qed.
Lemma crosses_outside_ext f g : (forall v, f v = g v) -> crosses_outside f = crosses_outside g.
Proof. intros H. unfold crosses_outside, straddles, through, passes_at, at_edge, edge_list. cbn. now rewrite !H. Qed.
Lemma real_crosses v1 v2 w0 w1 w2 : RK.crosses (real v1) (real v2) (real w0) (real w1) (real w2) = IK.crosses v1 v2 w0 w1 w2.
Proof.
  unfold RK.crosses, IK.crosses.
  rewrite (forallb_ext _ (fun v => seq (I.S.sign_of (I.S.fifteen v1 v2 w0 w1 w2) v) O)) by (intros; now rewrite real_sign).
  rewrite (forallb_ext _ (fun v => seq (I.S.sign_of (I.S.fifteen v1 v2 w0 w1 w2) v) O) [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive) by (intros; now rewrite real_sign).
  rewrite (crosses_outside_ext _ (I.S.sign_of (I.S.fifteen v1 v2 w0 w1 w2))) by (intros; apply real_sign).
  rewrite real_separate. destruct (forallb _ [1; 2; 3; 4; 5; 6]%positive); auto. f_equal. unfold RK.inside, IK.inside.
  rewrite !real_boxes_nearly, (real_moment _ _ _ _ _ _ I.S.X), (real_moment _ _ _ _ _ _ I.S.Y), (real_moment _ _ _ _ _ _ I.S.Z) by reflexivity.
  rewrite (real_nearly_parted _ _ _ _ _ _ I.along_x), (real_nearly_parted _ _ _ _ _ _ I.along_y), (real_nearly_parted _ _ _ _ _ _ I.along_z) by reflexivity.
  destruct (I.some_moment _ _ _ _ _ I.S.X); auto. destruct (I.some_moment _ _ _ _ _ I.S.Y); auto. destruct (I.some_moment _ _ _ _ _ I.S.Z); auto.
  change [real v1; real v2] with (map real [v1; v2]). change [real w0; real w1; real w2] with (map real [w0; w1; w2]).
  rewrite !real_first, <- real_cross, real_zero. destruct (I.zero_vec _); auto.
  cbn [existsb]. rewrite <- !real_straddle. cbn. now rewrite !sg_IZR.
Qed.

(** The relative interior: all three weights are positive. *)
Definition inside_triangle (a b c x : point) : Prop := exists l m n, 0 < l /\ 0 < m /\ 0 < n /\ l + m + n = 1 /\
  let '(ax, ay, az) := a in let '(bx, by_, bz) := b in let '(cx, cy, cz) := c in
  x = (l * ax + m * bx + n * cx, l * ay + m * by_ + n * cy, l * az + m * bz + n * cz).
Definition cross_each_other (a b c d e f : point) : Prop := exists x, inside_triangle a b c x /\ inside_triangle d e f x.
Lemma cross_common (a b c d e f : R.S.vec) :
  RK.cross_ a b c d e f <-> cross_each_other (place_of a) (place_of b) (place_of c) (place_of d) (place_of e) (place_of f).
Proof.
  unfold RK.cross_, RK.balance, RK.all_positive, R.S.combine, cross_each_other, place_of; cbn. split.
  - intros (x & [H S] & Q). assert (G : forall i, (i < 6)%nat -> 0 < x i) by (intros i Hi; now apply RealNumbers.sg_P, Q).
    unfold RealNumbers.add, RealNumbers.mul in *. injection H as H1 H2 H3.
    pose proof (G 0%nat ltac:(lia)). pose proof (G 1%nat ltac:(lia)). pose proof (G 2%nat ltac:(lia)).
    set (t := x 0%nat + x 1%nat + x 2%nat) in *. assert (T : 0 < t) by (unfold t; lra).
    assert (D : forall y, 0 < y -> 0 < y / t) by (intros; apply Rdiv_lt_0_compat; auto).
    exists ((x 0%nat * R.S.X a + x 1%nat * R.S.X b + x 2%nat * R.S.X c) / t, (x 0%nat * R.S.Y a + x 1%nat * R.S.Y b + x 2%nat * R.S.Y c) / t,
      (x 0%nat * R.S.Z a + x 1%nat * R.S.Z b + x 2%nat * R.S.Z c) / t). split.
    + exists (x 0%nat / t), (x 1%nat / t), (x 2%nat / t). repeat split; auto; [unfold t; field; fold t; lra|]. f_equal; [f_equal|]; field; lra.
    + exists (x 3%nat / t), (x 4%nat / t), (x 5%nat / t). repeat split; try (apply D, G; lia); [rewrite S; field; lra|]. rewrite H1, H2, H3. f_equal; [f_equal|]; field; lra.
  - intros (x & (l & m & n & L0 & L1 & L2 & LS & LE) & (l' & m' & n' & L3 & L4 & L5 & LS' & LE')).
    exists (fun i => nth i [l; m; n; l'; m'; n'] 0). cbn. rewrite LE in LE'. injection LE' as H1 H2 H3.
    unfold RealNumbers.add, RealNumbers.mul. split; [split; [f_equal; assumption|lra]|].
    intros i Hi. apply RealNumbers.sg_P. do 6 (destruct i as [|i]; [cbn; assumption|]). lia.
Qed.
Theorem exact_crossing_is_right (a b c d e f : I.S.vec) :
  IK.exact_crosses a b c d e f = true <->
  cross_each_other (of_grid a) (of_grid b) (of_grid c) (of_grid d) (of_grid e) (of_grid f).
Proof.
  assert (E : IK.exact_crosses a b c d e f = RK.exact_crosses (real a) (real b) (real c) (real d) (real e) (real f)).
  { unfold IK.exact_crosses, RK.exact_crosses. rewrite <- !real_minus. symmetry. apply real_crosses. }
  rewrite E, RK.crosses_right. apply cross_common.
Qed.

(** Statements beside the theorems that are false: each is a theorem's with one mistake, and falls by one example. A theorem that
    held of these too would say nothing.

    - [face_three_times]: F(x) with 3 x in place of 4 x (section 5 of docs/determinants.md);
    - [gap_of_one]: boxes apart by 1 (section 6);
    - [four_missed_edges]: separate if four of six edges are missed (section 6);
    - [weak_eleven_axes]: the eleven axes with <= in place of <, for triangles in one plane (section 6 of docs/contract.md);
    - [only_piercing_edges]: an exact rule that asks for a piercing edge where it should ask for one that hits (docs/exact.md);
    - [boxes_that_touch]: boxes that are apart in place of nearly apart, for whether a pair on one line crosses (docs/exact.md);
    - [words_stand]: what the theorem of the determinant unit assumes of words and numbers can be;
    - [mute]: and the units do answer: a pair that is certainly separate, and one that certainly meets. *)
From Coq Require Import ZArith Reals Lra Lia List Bool.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.Triple Efsat.Verdict Efsat.RealSpace Efsat.Vectors Efsat.Determinants Efsat.DeterminantUnit.
Import ListNotations.
Local Open Scope Z_scope.

(** Three corners of the cube, V1 and V2 in the origin: the error of side[0][0] comes from V1 alone, and takes its whole bound. *)
Definition zero := Z3 0 0 0.
Definition far := 2 ^ 17 - 1.
Definition cube := Points zero zero (Tri (Z3 far far far) (Z3 far (- far) far) zero).
Definition cube_moments := rounded 18 (exact_moments cube).
Definition face := of_m Norms 18 18 cube cube_moments T0 + of_vertex Norms 18 18 cube (V1 cube) T0 + of_vertex Norms 18 18 cube (V1 cube) T1.
(** How far V1 is off. *)
Definition off := V3 (5 / 8) 0 (- (5 / 8)).
Theorem face_three_times : fits 18 (V1 cube) /\ fits 18 (V2 cube) /\ (forall l, fits 18 (W cube l)) /\ within (eps 0) off /\
  let v1 := plus (real (V1 cube)) off in let w0 := real (W cube T0) in let w1 := real (W cube T1) in
  ~ near 18 (side (numbers cube cube_moments) T0 T0) (side (bounds Norms 18 18 0 cube cube_moments) T0 T0 - face) (- dot v1 (cross w0 w1)).
Proof.
  assert (Ff : forall v, In v [zero; Z3 far far far; Z3 far (- far) far] -> fits 18 v) by (intros v [<-|[<-|[<-|[]]]]; unfold fits; cbn; lia).
  split; [apply Ff; cbn; auto|]. split; [apply Ff; cbn; auto|]. split; [intros []; apply Ff; cbn; auto|].
  split; [unfold within, eps, off; cbn; repeat split; apply Rabs_le; lra|].
  cbv zeta. unfold near. intros H.
  assert (E1 : side (numbers cube cube_moments) T0 T0 = 0) by (vm_compute; reflexivity).
  assert (E2 : side (bounds Norms 18 18 0 cube cube_moments) T0 T0 - face = 1048688) by (vm_compute; reflexivity).
  rewrite E1, E2 in H. unfold off, plus, real, cross, dot in H. cbn [V1 W cube zero get ZX ZY ZZ X Y Z_] in H.
  unfold Rabs in H. change far with 131071 in H. rewrite ?opp_IZR in H. destruct (Rcase_abs _) in H; lra.
Qed.

(** A in the origin, B one step beside it: they can be the same point. *)
Definition beside := Points zero zero (Tri (Z3 1 0 0) (Z3 1 0 0) (Z3 1 0 0)).
Theorem gap_of_one : boxes_apart 1 beside = true /\ boxes_apart (box_gap 0) beside = false /\
  let v := V3 (1 / 2) 0 0 in let w := V3 (1 / 2) 0 0 in
  within (eps 0) (minus v (real zero)) /\ within (eps 0) (minus w (real (Z3 1 0 0))) /\
  common (0, 0, 0)%R (place_of v) (place_of v) (place_of w) (place_of w) (place_of w).
Proof.
  split; [reflexivity|]. split; [reflexivity|]. cbv zeta.
  split; [unfold within, minus, eps; cbn; repeat split; apply Rabs_le; lra|]. split; [unfold within, minus, eps; cbn; repeat split; apply Rabs_le; lra|].
  exists (1 / 2, 0, 0)%R. split; [exists 0%R, 1%R, 0%R|exists 1%R, 0%R, 0%R]; unfold place_of; cbn; (repeat split; try lra); f_equal; [f_equal| |f_equal|]; lra.
Qed.

(** A triangle and one that pierces it with two edges: the other four are missed. *)
Definition v (x y z : Z) := I.S.V3 x y z.
Definition piercing := I.S.sign_of (I.S.fifteen (v 8 0 0) (v 0 8 0) (v 2 2 (-4)) (v 2 3 4) (v 3 2 4)).
Theorem four_missed_edges : length (filter (at_edge misses piercing) edge_list) = 4%nat /\
  I.S.meet I.S.origin (v 8 0 0) (v 0 8 0) (v 2 2 (-4)) (v 2 3 4) (v 3 2 4).
Proof. split; [vm_compute; reflexivity|]. apply I.separate_right. vm_compute. reflexivity. Qed.

(** Two triangles in one plane, apart. *)
Definition weakly_overlaps us ws l := exists u w u' w', In u us /\ In w ws /\ In u' us /\ In w' ws /\ I.S.dot l u <= I.S.dot l w /\ I.S.dot l w' <= I.S.dot l u'.
Theorem weak_eleven_axes : let us := [I.S.origin; v 1 0 0; v 0 1 0] in let ws := [v 5 5 0; v 6 5 0; v 5 6 0] in
  Forall (weakly_overlaps us ws) (OnIntegers.A.eleven (v 1 0 0) (v 0 1 0) (v 5 5 0) (v 6 5 0) (v 5 6 0)) /\ ~ I.S.meet I.S.origin (v 1 0 0) (v 0 1 0) (v 5 5 0) (v 6 5 0) (v 5 6 0).
Proof.
  split.
  - repeat apply Forall_cons; try apply Forall_nil; exists I.S.origin, (v 5 5 0), I.S.origin, (v 5 5 0); repeat split; cbn; auto; lia.
  - intros M. apply I.separate_right in M. vm_compute in M. discriminate.
Qed.

(** A corner on a face. *)
Definition on_face := I.S.sign_of (I.S.fifteen (v 8 0 0) (v 0 8 0) (v 2 2 0) (v 2 3 4) (v 3 2 4)).
Theorem only_piercing_edges : existsb (at_edge pierces on_face) edge_list = false /\ existsb (at_edge hits on_face) edge_list = true /\
  I.S.meet I.S.origin (v 8 0 0) (v 0 8 0) (v 2 2 0) (v 2 3 4) (v 3 2 4).
Proof. split; [vm_compute; reflexivity|]. split; [vm_compute; reflexivity|]. apply I.separate_right. vm_compute. reflexivity. Qed.

Definition default := Options 18 28 On 6 0 6 1 Norms true.
Definition point x y z := Z3 (x * 2 ^ 20) (y * 2 ^ 20) (z * 2 ^ 20).
Definition still a b := Words a b (Tri zero zero zero) zero true.
Theorem mute : DeterminantUnit.valid default = true /\
  verdict (unit default (still (Tri zero (point 8 0 0) (point 0 8 0)) (Tri (point 2 2 (-4)) (point 2 3 4) (point 3 2 4)))) = Intersect /\
  verdict (unit default (still (Tri zero (point 8 0 0) (point 0 8 0)) (Tri (point 2 2 1) (point 2 3 4) (point 3 2 4)))) = Separate.
Proof. repeat split; vm_compute; reflexivity. Qed.

(** Two segments that touch at an end. *)
Theorem boxes_that_touch : I.boxes_apart (v 8 0 0) (v 8 0 0) (v 8 0 0) (v 16 0 0) (v 16 0 0) = false /\
  ~ IK.cross_ I.S.origin (v 8 0 0) (v 8 0 0) (v 8 0 0) (v 16 0 0) (v 16 0 0).
Proof. split; [vm_compute; reflexivity|]. intros K. apply IK.origin_crosses in K. vm_compute in K. discriminate. Qed.

(** Words of numbers on the grid. *)
Definition on_words i := Truth (fun k => real (A i k)) (fun k => real (B i k)) (fun k => real (M i k)) (real (t i)).
Theorem words_stand (a b : triple zvec) : (forall k, Z.abs (ZX (b k)) <= 2 ^ 28 /\ Z.abs (ZY (b k)) <= 2 ^ 28 /\ Z.abs (ZZ (b k)) <= 2 ^ 28) ->
  stands_for default (still a b) (on_words (still a b)).
Proof.
  assert (F : forall w, floors w (real w)) by (intros w; unfold floors, floor_of, real; cbn; repeat split; lra).
  intros Hb. split; [intros; apply F|]. split; [intros; apply F|]. split; [intros; apply F|]. split; [apply F|]. intros _ k. unfold on_words, declared, within, real. cbn [TB TM X Y Z_].
  destruct (Hb k) as (H1 & H2 & H3). split; (split; [|split]); rewrite <- abs_IZR; apply IZR_le; try assumption; destruct k; cbn; lia.
Qed.

(** The collision engine loses no pair: docs/engine.md.

    If a point of a volume of A is a point of a volume of B in a pose, the test of no direction says that the volumes are apart,
    whatever the factors of a row are: [touching_volumes_are_not_apart]. So the traversal of two trees, which opens every pair of
    volumes that are not apart, reaches every pair of triangles that have a common point: [no_pair_is_lost]. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
Require Import Efsat.Triple Efsat.Vectors.
Import ListNotations.
Local Open Scope R_scope.

(** * The test *)
(** All lengths are in steps G of the common grid. The directions are of 0, 1 and -1. *)
Record direction := Direction { hx : Z; hy : Z; hz : Z }.
Definition vector d := V3 (IZR (hx d)) (IZR (hy d)) (IZR (hz d)).
Definition unit_entries d : Prop := (Z.abs (hx d) <= 1 /\ Z.abs (hy d) <= 1 /\ Z.abs (hz d) <= 1)%Z.
Definition opposite d := Direction (- hx d) (- hy d) (- hz d).
Definition lies (h : direction) (v : vec) : R := dot (vector h) v.

(** A volume: the origin of its block, its exponent, and the code of each direction. *)
Record volume := Volume { origin : vec; exponent : Z; codes : direction -> Z }.
Definition contains (directions : direction -> Prop) (v : volume) (x : vec) : Prop :=
  forall n, directions n -> lies n (minus x (origin v)) <= IZR (codes v n * 2 ^ exponent v).

(** A row: three directions of B with factors in steps of 2^-(f-1), and what these leave. *)
Record row := Row { j0 : direction; j1 : direction; j2 : direction; l0 : Z; l1 : Z; l2 : Z; rest : Z }.
(** D is the place of B's origin seen from A's, rounded. *)
Record seen := Seen { Dx : Z; Dy : Z; Dz : Z; ex : Z; ey : Z; ez : Z }.
Local Open Scope Z_scope.
Definition ceiling x d := - ((- x) / d).
Definition apart (f : Z) (s : seen) (h : direction) (r : row) (a b : volume) : bool :=
  let B := hx h * Dx s + hy h * Dy s + hz h * Dz s + (Z.abs (hx h) * ex s + Z.abs (hy h) * ey s + Z.abs (hz h) * ez s) in
  let S := l0 r * codes b (j0 r) + l1 r * codes b (j1 r) + l2 r * codes b (j2 r) + rest r in
  let U := ceiling (S * 2 ^ exponent b) (2 ^ (f - 1)) in
  let V := codes a (opposite h) * 2 ^ exponent a in
  B + U + V <? 0.
Local Open Scope R_scope.

(** The pose: a point y of B is at M y + t. *)
Record pose := Pose { M : three -> vec; t : vec }.
Definition at_ (p : pose) (y : vec) : vec := V3 (dot (M p T0) y + X (t p)) (dot (M p T1) y + Y (t p)) (dot (M p T2) y + Z_ (t p)).
(** w = M^T h. *)
Definition column (p : pose) (h : direction) : vec :=
  V3 (IZR (hx h) * X (M p T0) + IZR (hy h) * X (M p T1) + IZR (hz h) * X (M p T2))
     (IZR (hx h) * Y (M p T0) + IZR (hy h) * Y (M p T1) + IZR (hz h) * Y (M p T2))
     (IZR (hx h) * Z_ (M p T0) + IZR (hy h) * Z_ (M p T1) + IZR (hz h) * Z_ (M p T2)).
(** What the host sends: the shift is wrong by no more than its error ... *)
Definition shift_within (p : pose) (a b : volume) (s : seen) : Prop :=
  let d := minus (at_ p (origin b)) (origin a) in
  Rabs (X d - IZR (Dx s)) <= IZR (ex s) /\ Rabs (Y d - IZR (Dy s)) <= IZR (ey s) /\ Rabs (Z_ d - IZR (Dz s)) <= IZR (ez s).
(** ... and the rest bounds what the factors leave of w, on the greatest codes. *)
Definition left_by (f : Z) (p : pose) (h : direction) (r : row) : vec :=
  let e := IZR (2 ^ (f - 1)) in let w := column p h in
  let n g := vector (g r) in
  V3 (e * X w - (IZR (l0 r) * X (n j0) + IZR (l1 r) * X (n j1) + IZR (l2 r) * X (n j2)))
     (e * Y w - (IZR (l0 r) * Y (n j0) + IZR (l1 r) * Y (n j1) + IZR (l2 r) * Y (n j2)))
     (e * Z_ w - (IZR (l0 r) * Z_ (n j0) + IZR (l1 r) * Z_ (n j1) + IZR (l2 r) * Z_ (n j2))).
Definition rest_within (f most : Z) (p : pose) (h : direction) (r : row) : Prop := IZR most * norm (left_by f p h r) <= IZR (rest r).

(** The host sends the row of one of two opposite directions. With the opposite directions it is that of the other one. *)
Definition turned (r : row) := Row (opposite (j0 r)) (opposite (j1 r)) (opposite (j2 r)) (l0 r) (l1 r) (l2 r) (rest r).
Theorem one_row_serves_two_directions f most p h r : rest_within f most p h r -> rest_within f most p (opposite h) (turned r).
Proof.
  unfold rest_within. intros H. replace (norm (left_by f p (opposite h) (turned r))) with (norm (left_by f p h r)); [exact H|].
  assert (E : forall x y, y = - x -> Rabs x = Rabs y) by (intros x y ->; symmetry; apply Rabs_Ropp).
  unfold norm, left_by, column, vector, turned, opposite; cbn. rewrite !opp_IZR. f_equal; [f_equal|]; apply E; ring.
Qed.

(** The coordinate axes are among the directions of every set, and no code is above [most]. *)
Definition set_of_directions (directions : direction -> Prop) : Prop :=
  (forall n, directions n -> unit_entries n) /\ (forall n, directions n -> directions (opposite n)) /\
  directions (Direction 1 0 0) /\ directions (Direction 0 1 0) /\ directions (Direction 0 0 1).

(** The error that the host sends with a shift is enough: along one axis of A, with rows m of M and m' of its rounded matrix, the
    origin of B's block at most H steps from the centre, and a shift that is rounded down by at most r. *)
Theorem host_error_is_enough (m m' o : vec) (shift shift' H r e : R) : 0 <= H -> within H o -> 0 <= shift - shift' <= r ->
  norm (minus m m') * H + 1 + r <= e ->
  Rabs (dot m o + shift - (IZR (Int_part (dot m' o)) + shift')) <= e.
Proof.
  intros HH Ho Hr He. destruct (base_Int_part (dot m' o)) as [A B].
  pose proof (dot_bound _ _ (minus m m') Ho) as K. replace (dot o (minus m m')) with (dot m o - dot m' o) in K by (unfold dot, minus; cbn; ring).
  apply Rabs_le_inv in K. apply Rabs_le. lra.
Qed.

Lemma ceiling_above x d : (0 < d)%Z -> IZR x <= IZR (ceiling x d) * IZR d.
Proof.
  intros H. rewrite <- mult_IZR. apply IZR_le. unfold ceiling. pose proof (Z.mul_div_le (- x) d H). lia.
Qed.
Lemma opposite_lies h v : lies (opposite h) v = - lies h v.
Proof. unfold lies, dot, vector, opposite; cbn. rewrite !opp_IZR. ring. Qed.
Lemma entry_times (c : Z) (x : R) (e : Z) : (Z.abs c <= 1)%Z -> Rabs x <= IZR e -> IZR c * x <= IZR (Z.abs c * e).
Proof.
  intros H A. rewrite mult_IZR, abs_IZR. eapply Rle_trans; [apply Rle_abs|]. rewrite Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|exact A].
Qed.

Theorem touching_volumes_are_not_apart directions f most p s h r a b x y : set_of_directions directions ->
  directions h -> directions (j0 r) -> directions (j1 r) -> directions (j2 r) -> (0 <= l0 r)%Z -> (0 <= l1 r)%Z -> (0 <= l2 r)%Z -> (1 <= f)%Z ->
  (0 <= exponent b)%Z -> (forall n, directions n -> (codes b n <= most)%Z) ->
  shift_within p a b s -> rest_within f most p h r ->
  contains directions a x -> contains directions b y -> x = at_ p y -> apart f s h r a b = false.
Proof.
  intros (UD & OD & DX & DY & DZ) Dh D0 D1 D2 L0 L1 L2 Hf Eb Most (S1 & S2 & S3) Rest CA CB ->.
  unfold apart. apply Z.ltb_ge. apply le_IZR. cbv zeta. rewrite !plus_IZR, !mult_IZR.
  set (U := IZR (ceiling _ _)). destruct (UD h Dh) as (H1 & H2 & H3).
  (* (1) *)
  pose proof (CA (opposite h) (OD h Dh)) as A. rewrite opposite_lies, mult_IZR in A.
  (* (2), (3) *)
  set (o := minus (at_ p (origin b)) (origin a)) in *.
  pose proof (entry_times (hx h) (X o - IZR (Dx s)) (ex s) H1 S1) as T1. pose proof (entry_times (hy h) (Y o - IZR (Dy s)) (ey s) H2 S2) as T2.
  pose proof (entry_times (hz h) (Z_ o - IZR (Dz s)) (ez s) H3 S3) as T3. rewrite !mult_IZR in T1, T2, T3.
  set (z := minus y (origin b)).
  assert (E : lies h (minus (at_ p y) (origin a)) = lies h o + dot (column p h) z) by (unfold lies, o, z, column, at_, dot, minus, vector; cbn; ring).
  (* (4) *)
  assert (CZ : forall n, directions n -> lies n z <= IZR (codes b n * 2 ^ exponent b)) by exact CB. clearbody z. clear CB.
  assert (P : (0 < 2 ^ (f - 1))%Z) by (apply Z.pow_pos_nonneg; lia). assert (Q : (0 < 2 ^ exponent b)%Z) by (apply Z.pow_pos_nonneg; lia).
  assert (W : dot (column p h) z <= U).
  { apply IZR_lt in P, Q. set (F := IZR (2 ^ (f - 1))) in *. set (E2 := IZR (2 ^ exponent b)) in *.
    assert (Z1 : within (IZR most * E2) z).
    { assert (T : forall n, directions n -> lies n z <= IZR most * E2).
      { intros n Dn. eapply Rle_trans; [apply (CZ n Dn)|]. rewrite mult_IZR. fold E2. apply Rmult_le_compat_r; [lra|]. apply IZR_le, Most, Dn. }
      pose proof (T _ DX) as T4. pose proof (T _ (OD _ DX)) as T5. pose proof (T _ DY) as T6. pose proof (T _ (OD _ DY)) as T7. pose proof (T _ DZ) as T8. pose proof (T _ (OD _ DZ)) as T9.
      rewrite opposite_lies in T5, T7, T9. unfold lies, dot, vector in *; cbn in *. repeat split; apply Rabs_le; lra. }
    assert (B0 : IZR (l0 r) * lies (j0 r) z <= IZR (l0 r) * (IZR (codes b (j0 r)) * E2)) by (apply Rmult_le_compat_l; [apply IZR_le; auto|unfold E2; rewrite <- mult_IZR; apply CZ, D0]).
    assert (B1 : IZR (l1 r) * lies (j1 r) z <= IZR (l1 r) * (IZR (codes b (j1 r)) * E2)) by (apply Rmult_le_compat_l; [apply IZR_le; auto|unfold E2; rewrite <- mult_IZR; apply CZ, D1]).
    assert (B2 : IZR (l2 r) * lies (j2 r) z <= IZR (l2 r) * (IZR (codes b (j2 r)) * E2)) by (apply Rmult_le_compat_l; [apply IZR_le; auto|unfold E2; rewrite <- mult_IZR; apply CZ, D2]).
    assert (R0 : dot z (left_by f p h r) <= IZR (rest r) * E2).
    { eapply Rle_trans; [apply Rle_abs|]. eapply Rle_trans; [apply dot_bound; exact Z1|]. unfold rest_within in Rest.
      replace (IZR most * E2 * norm (left_by f p h r)) with (IZR most * norm (left_by f p h r) * E2) by ring. apply Rmult_le_compat_r; lra. }
    assert (Sum : F * dot (column p h) z = IZR (l0 r) * lies (j0 r) z + IZR (l1 r) * lies (j1 r) z + IZR (l2 r) * lies (j2 r) z + dot z (left_by f p h r)).
    { unfold left_by, lies, dot, vector; cbn. fold F. ring. }
    pose proof (ceiling_above ((l0 r * codes b (j0 r) + l1 r * codes b (j1 r) + l2 r * codes b (j2 r) + rest r) * 2 ^ exponent b) (2 ^ (f - 1)) ltac:(apply lt_IZR; exact P)) as C.
    fold U F in C. rewrite mult_IZR, !plus_IZR, !mult_IZR in C. fold E2 in C.
    apply (Rmult_le_reg_r F); auto. lra. }
  assert (L : lies h o = IZR (hx h) * X o + IZR (hy h) * Y o + IZR (hz h) * Z_ o) by reflexivity. clearbody o U. lra.
Qed.

(** * The traversal *)
(** Trees of any volumes; both of two nodes are opened at once, a triangle stands for itself. *)
Section Traversal.
  Variables volume_a volume_b triangle_a triangle_b : Type.
  Inductive tree (volume triangle : Type) := Leaf (v : volume) (x : triangle) | Node (v : volume) (l r : tree volume triangle).
  Arguments Leaf {volume triangle}. Arguments Node {volume triangle}.
  Definition top {v x} (n : tree v x) := match n with Leaf v _ | Node v _ _ => v end.
  Definition children {v x} (n : tree v x) := match n with Leaf _ _ => [n] | Node _ l r => [l; r] end.
  Fixpoint triangles {v x} (n : tree v x) := match n with Leaf _ x => [x] | Node _ l r => triangles l ++ triangles r end.
  Fixpoint height {v x} (n : tree v x) : nat := match n with Leaf _ _ => 0 | Node _ l r => S (Nat.max (height l) (height r)) end.

  Variable are_apart : volume_a -> volume_b -> bool.
  (** The pairs of triangles that are left. [level] counts what is still to be opened. *)
  Fixpoint leaf_pairs (level : nat) (m : tree volume_a triangle_a) (n : tree volume_b triangle_b) : list (triangle_a * triangle_b) :=
    match m, n, level with
    | Leaf _ x, Leaf _ y, _ => [(x, y)]
    | _, _, 0%nat => []
    | _, _, S level => flat_map (fun c => flat_map (fun d => if are_apart (top c) (top d) then [] else leaf_pairs level c d) (children n)) (children m)
    end.

  (** A volume holds a triangle, and touching triangles keep their volumes from being apart. *)
  Variable holds_a : volume_a -> triangle_a -> Prop. Variable holds_b : volume_b -> triangle_b -> Prop.
  Variable touch : triangle_a -> triangle_b -> Prop.
  Hypothesis Test : forall v w x y, holds_a v x -> holds_b w y -> touch x y -> are_apart v w = false.
  Fixpoint bounded {v x} (holds : v -> x -> Prop) (n : tree v x) : Prop :=
    (forall x, In x (triangles n) -> holds (top n) x) /\ match n with Leaf _ _ => True | Node _ l r => bounded holds l /\ bounded holds r end.

  Lemma child_with {v x} (holds : v -> x -> Prop) (n : tree v x) y : bounded holds n -> In y (triangles n) ->
    exists c, In c (children n) /\ In y (triangles c) /\ bounded holds c /\ (height c <= pred (height n))%nat.
  Proof.
    destruct n as [w z|w l r]; cbn; intros B I.
    - exists (Leaf w z). cbn. auto.
    - destruct B as (_ & Bl & Br). apply in_app_iff in I as [I|I]; [exists l|exists r]; repeat split; auto; lia.
  Qed.
  Theorem no_pair_is_lost level m n x y : (height m <= level /\ height n <= level)%nat -> bounded holds_a m -> bounded holds_b n ->
    In x (triangles m) -> In y (triangles n) -> touch x y -> In (x, y) (leaf_pairs level m n).
  Proof.
    intros L'.
    revert m n L'. induction level as [|level IH]; intros m n [Lm Ln] Bm Bn Im In_ T.
    - destruct m, n; cbn in Lm, Ln; try lia. cbn in Im, In_ |- *. destruct Im as [->|[]], In_ as [->|[]]. auto.
    - assert (G : In (x, y) (flat_map (fun c => flat_map (fun d => if are_apart (top c) (top d) then [] else leaf_pairs level c d) (children n)) (children m))).
      { destruct (child_with _ _ _ Bm Im) as (c & Ic & Xc & Bc & Lc), (child_with _ _ _ Bn In_) as (d & Id & Yd & Bd & Ld).
        apply in_flat_map. exists c. split; auto. apply in_flat_map. exists d. split; auto.
        assert (A : are_apart (top c) (top d) = false).
        { apply (Test _ _ x y); auto; [destruct c|destruct d]; cbn in *; intuition. }
        rewrite A. apply IH; auto. lia. }
      destruct m, n; try exact G. cbn in Im, In_ |- *. destruct Im as [->|[]], In_ as [->|[]]. auto.
  Qed.
End Traversal.

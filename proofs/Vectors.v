(** Vectors of real numbers and the L1 norm. How far a determinant can move if its corners do, each coordinate by at most eps:
    section 7.3 of docs/determinants.md. *)
From Coq Require Import ZArith Reals Lra Lia Psatz.
Local Open Scope R_scope.

Record vec := V3 { X : R; Y : R; Z_ : R }.
Definition plus u v := V3 (X u + X v) (Y u + Y v) (Z_ u + Z_ v).
Definition minus u v := V3 (X u - X v) (Y u - Y v) (Z_ u - Z_ v).
Definition cross u v := V3 (Y u * Z_ v - Z_ u * Y v) (Z_ u * X v - X u * Z_ v) (X u * Y v - Y u * X v).
Definition dot u v := X u * X v + Y u * Y v + Z_ u * Z_ v.
Definition norm u := Rabs (X u) + Rabs (Y u) + Rabs (Z_ u).
Definition within (e : R) u := Rabs (X u) <= e /\ Rabs (Y u) <= e /\ Rabs (Z_ u) <= e.

Lemma abs_mul a b e : Rabs a <= e -> Rabs (a * b) <= e * Rabs b.
Proof. intros H. rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|exact H]. Qed.
Lemma Rabs_le_inv x e : Rabs x <= e -> - e <= x <= e.
Proof. unfold Rabs. destruct (Rcase_abs x); lra. Qed.
Lemma norm_pos u : 0 <= norm u.
Proof. unfold norm. pose proof (Rabs_pos (X u)). pose proof (Rabs_pos (Y u)). pose proof (Rabs_pos (Z_ u)). lra. Qed.
Lemma dot_bound e d n : within e d -> Rabs (dot d n) <= e * norm n.
Proof.
  intros (A & B & C). unfold dot, norm.
  pose proof (abs_mul _ (X n) _ A). pose proof (abs_mul _ (Y n) _ B). pose proof (abs_mul _ (Z_ n) _ C).
  pose proof (Rabs_triang (X d * X n + Y d * Y n) (Z_ d * Z_ n)). pose proof (Rabs_triang (X d * X n) (Y d * Y n)). lra.
Qed.
Lemma within_norm e u : within e u -> norm u <= 3 * e.
Proof. intros (A & B & C). unfold norm. lra. Qed.
Lemma cross_within e f u v : within e u -> within f v -> 0 <= e -> within (2 * e * f) (cross u v).
Proof.
  intros (A & B & C) (A' & B' & C') He.
  assert (T : forall a b c d, Rabs a <= e -> Rabs b <= f -> Rabs c <= e -> Rabs d <= f -> Rabs (a * b - c * d) <= 2 * e * f).
  { intros a b c d Ha Hb Hc Hd. pose proof (abs_mul a b e Ha). pose proof (abs_mul c d e Hc).
    pose proof (Rmult_le_compat_l e _ _ He Hb). pose proof (Rmult_le_compat_l e _ _ He Hd).
    pose proof (Rabs_triang (a * b) (- (c * d))). rewrite Rabs_Ropp in *. unfold Rminus. lra. }
  repeat split; cbn; apply T; auto.
Qed.
(** |q x r| <= 2 max |r_j| |q| *)
Lemma cross_norm e q r : within e r -> norm (cross q r) <= 2 * e * norm q.
Proof.
  intros (A & B & C).
  assert (T : forall a b c d, Rabs b <= e -> Rabs d <= e -> Rabs (a * b - c * d) <= e * Rabs a + e * Rabs c).
  { intros a b c d Hb Hd. pose proof (abs_mul b a e Hb). pose proof (abs_mul d c e Hd).
    pose proof (Rabs_triang (a * b) (- (c * d))). rewrite Rabs_Ropp in *. rewrite (Rmult_comm a b), (Rmult_comm c d) in *. unfold Rminus. lra. }
  unfold norm. cbn.
  pose proof (T (Y q) (Z_ r) (Z_ q) (Y r) C B). pose proof (T (Z_ q) (X r) (X q) (Z_ r) A C). pose proof (T (X q) (Y r) (Y q) (X r) B A). lra.
Qed.
Lemma norm_opp_cross q r : norm (cross q r) = norm (cross r q).
Proof.
  unfold norm; cbn. f_equal; [f_equal|]; rewrite <- Rabs_Ropp; f_equal; ring.
Qed.
Lemma cross_norm_min e q r : within e q -> within e r -> norm (cross q r) <= 2 * e * Rmin (norm q) (norm r).
Proof.
  intros Q S. unfold Rmin. destruct (Rle_dec (norm q) (norm r)); [now apply cross_norm|rewrite norm_opp_cross; now apply cross_norm].
Qed.

Ltac triangle e := match e with ?a + ?b => pose proof (Rabs_triang a b); triangle a | _ => idtac end.

(** Errors of three points beside an exact origin: Taylor's expansion, section 7.3 (c). *)
Lemma three_points eps p q r dp dq dr : 0 <= eps -> within eps dp -> within eps dq -> within eps dr ->
  Rabs (dot (cross (plus p dp) (plus q dq)) (plus r dr) - dot (cross p q) r) <=
  eps * (norm (cross p q) + norm (cross q r) + norm (cross r p)) + 2 * eps * eps * (norm p + norm q + norm r) + 6 * eps * eps * eps.
Proof.
  intros He Hp Hq Hr.
  replace (dot (cross (plus p dp) (plus q dq)) (plus r dr) - dot (cross p q) r) with
    (dot dr (cross p q) + dot dp (cross q r) + dot dq (cross r p)
     + dot (cross dp dq) r + dot (cross dq dr) p + dot (cross dr dp) q + dot (cross dp dq) dr) by (unfold dot, cross, plus; cbn; ring).
  pose proof (dot_bound _ _ (cross p q) Hr). pose proof (dot_bound _ _ (cross q r) Hp). pose proof (dot_bound _ _ (cross r p) Hq).
  pose proof (dot_bound _ _ r (cross_within _ _ _ _ Hp Hq He)). pose proof (dot_bound _ _ p (cross_within _ _ _ _ Hq Hr He)).
  pose proof (dot_bound _ _ q (cross_within _ _ _ _ Hr Hp He)).
  pose proof (dot_bound _ _ dr (cross_within _ _ _ _ Hp Hq He)) as T. pose proof (within_norm _ _ Hr) as N.
  assert (0 <= 2 * eps * eps) as E2 by nra. pose proof (Rmult_le_compat_l _ _ _ E2 N).
  match goal with |- Rabs ?e <= _ => triangle e end.
  lra.
Qed.

(** Four points, none of them exact: the corners of a tetrahedron. *)
Lemma four_points eps s p q r ds dp dq dr : 0 <= eps -> within eps ds -> within eps dp -> within eps dq -> within eps dr ->
  let t s p q r := dot (cross (minus p s) (minus q s)) (minus r s) in
  Rabs (t (plus s ds) (plus p dp) (plus q dq) (plus r dr) - t s p q r) <=
  eps * (norm (cross (minus p s) (minus q s)) + norm (cross (minus q s) (minus r s)) + norm (cross (minus r s) (minus p s))
    + norm (cross (minus q p) (minus r p)))
  + 2 * eps * eps * (norm (minus p s) + norm (minus q s) + norm (minus r s) + norm (minus q p) + norm (minus r q) + norm (minus p r))
  + 24 * eps * eps * eps.
Proof.
  intros He Hs Hp Hq Hr t. unfold t.
  match goal with |- Rabs ?d <= _ => replace d with
    (dot dr (cross (minus p s) (minus q s)) + dot dp (cross (minus q s) (minus r s)) + dot dq (cross (minus r s) (minus p s))
     - dot ds (cross (minus q p) (minus r p))
     + dot (cross dp dq) (minus r s) + dot (cross dq dr) (minus p s) + dot (cross dr dp) (minus q s)
     + dot (cross ds dr) (minus q p) + dot (cross ds dp) (minus r q) + dot (cross ds dq) (minus p r)
     + dot (cross dp dq) dr - dot (cross ds dq) dr - dot (cross dp ds) dr - dot (cross dp dq) ds) by (unfold dot, cross, plus, minus; cbn; ring) end.
  pose proof (dot_bound _ _ (cross (minus p s) (minus q s)) Hr). pose proof (dot_bound _ _ (cross (minus q s) (minus r s)) Hp).
  pose proof (dot_bound _ _ (cross (minus r s) (minus p s)) Hq). pose proof (dot_bound _ _ (cross (minus q p) (minus r p)) Hs).
  pose proof (dot_bound _ _ (minus r s) (cross_within _ _ _ _ Hp Hq He)). pose proof (dot_bound _ _ (minus p s) (cross_within _ _ _ _ Hq Hr He)).
  pose proof (dot_bound _ _ (minus q s) (cross_within _ _ _ _ Hr Hp He)). pose proof (dot_bound _ _ (minus q p) (cross_within _ _ _ _ Hs Hr He)).
  pose proof (dot_bound _ _ (minus r q) (cross_within _ _ _ _ Hs Hp He)). pose proof (dot_bound _ _ (minus p r) (cross_within _ _ _ _ Hs Hq He)).
  pose proof (dot_bound _ _ dr (cross_within _ _ _ _ Hp Hq He)). pose proof (dot_bound _ _ dr (cross_within _ _ _ _ Hs Hq He)).
  pose proof (dot_bound _ _ dr (cross_within _ _ _ _ Hp Hs He)). pose proof (dot_bound _ _ ds (cross_within _ _ _ _ Hp Hq He)).
  assert (0 <= 2 * eps * eps) as E2 by nra.
  pose proof (Rmult_le_compat_l _ _ _ E2 (within_norm _ _ Hr)). pose proof (Rmult_le_compat_l _ _ _ E2 (within_norm _ _ Hs)).
  unfold Rminus.
  match goal with |- Rabs ?e <= _ => triangle e end.
  repeat rewrite Rabs_Ropp in *. lra.
Qed.


(** The normal of two points of a cube: section 7.5, `static`. *)
Lemma cross_cube e p q : within e p -> within e q -> norm (cross p q) <= 4 * e * e.
Proof.
  intros (A & B & C) (A' & B' & C').
  assert (He : 0 <= e) by (eapply Rle_trans; [apply Rabs_pos|exact A]).
  assert (T : forall a b c : R, Rabs a <= e -> Rabs b <= e -> Rabs c <= e -> Rabs (b - c) + Rabs (c - a) + Rabs (a - b) <= 4 * e).
  { intros a b c. unfold Rabs. repeat destruct Rcase_abs; lra. }
  assert (S : forall r : R, exists s, (s = 1 \/ s = -1) /\ Rabs r = s * r).
  { intros r. unfold Rabs. destruct (Rcase_abs r); [exists (-1)|exists 1]; split; auto; lra. }
  unfold norm, cross; cbn.
  destruct (S (Y p * Z_ q - Z_ p * Y q)) as (s1 & H1 & ->), (S (Z_ p * X q - X p * Z_ q)) as (s2 & H2 & ->),
    (S (X p * Y q - Y p * X q)) as (s3 & H3 & ->).
  assert (M : forall s a, s = 1 \/ s = -1 -> Rabs a <= e -> Rabs (s * a) <= e).
  { intros s a [->| ->] H; rewrite Rabs_mult; [rewrite Rabs_pos_eq by lra|rewrite (Rabs_left (-1)) by lra]; lra. }
  pose proof (T _ _ _ (M _ _ H1 A') (M _ _ H2 B') (M _ _ H3 C')) as K.
  assert (L : forall s t, s = 1 \/ s = -1 -> t = 1 \/ t = -1 -> forall a b, Rabs (s * a - t * b) = Rabs (t * a - s * b)).
  { intros s t [->| ->] [->| ->] a b; unfold Rabs; repeat destruct Rcase_abs; lra. }
  assert (P : forall x y, Rabs x <= e -> x * y <= e * Rabs y).
  { intros x y H. eapply Rle_trans; [apply Rle_abs|]. rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|exact H]. }
  pose proof (P _ (s3 * Y q - s2 * Z_ q) A) as P1. pose proof (P _ (s1 * Z_ q - s3 * X q) B) as P2. pose proof (P _ (s2 * X q - s1 * Y q) C) as P3.
  rewrite (L s3 s2) in P1 by auto. rewrite (L s1 s3) in P2 by auto. rewrite (L s2 s1) in P3 by auto.
  assert (K' : e * (Rabs (s2 * Y q - s3 * Z_ q) + Rabs (s3 * Z_ q - s1 * X q) + Rabs (s1 * X q - s2 * Y q)) <= e * (4 * e)) by (apply Rmult_le_compat_l; lra).
  lra.
Qed.

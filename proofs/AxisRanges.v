(** The axis unit within its declared ranges: docs/contract.md, sections 3 and 10, docs/guard.md, and the lemmas of docs/proofs.md.

    Where a format is too narrow for a computed bound, the bound is saturated to one on the true number; the lemmas edge-extent and
    triangle-area say that it is one. So [axis_unit_is_right] holds of every table of formats that passes [valid], a test by
    computation. The guard lets through exactly the words of the declared ranges: [guard_keeps], [guard_replaces]. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
Require Import Efsat.Sign Efsat.Domain Efsat.Triple Efsat.RealSpace Efsat.Vectors Efsat.Interval Efsat.DeterminantUnit Efsat.AxisUnit.
Import ListNotations.
Local Open Scope Z_scope.

(** * Edge extents *)
(** Of A and of B, in the last place of the working format. *)
Definition extents o : Z * Z :=
  if renormalise o then (2 ^ (N o - 1), 2 ^ (N o - 1)) else
  match frame o with
  | Off => (2 * (2 ^ (N o - 1) - 2), 2 * (2 ^ (N o - 1) - 2))
  | Translate => (2 * 2 ^ (N o - K o), 2 * 2 ^ (N o - K o))
  | On => (2 * 2 ^ (N o - K o), 6 * 2 ^ (N o - K o)) end.
Definition valid o : bool := (0 <=? axis_places o) && (0 <=? K o) && (K o <=? N o) && (2 <=? N o) && (N o <=? T o) && saturates_beyond o (fst (extents o)) (snd (extents o)).
(** What the declared ranges say. With re-normalisation it is that A, and B behind the transform, have T bits. *)
Definition within_words o (x : triple ivec) := every (fun k => every (fun j => (Z.abs (lo (x k j)) <=? 2 ^ (T o - 1)) && (Z.abs (hi (x k j)) <=? 2 ^ (T o - 1)))).
Definition small (e : R) (v : vec) : Prop := forall j, (Rabs (comp v j) <= e)%R.
Definition declared o i u : Prop :=
  if renormalise o then within_words o (a_of o i) = true /\ within_words o (b_of o i) = true else
  let e := match frame o with Off => IZR (2 ^ (T o - 1) - 2 * 2 ^ (T o - N o)) | _ => IZR (2 ^ (T o - K o)) end in
  forall k, small e (TA u k) /\ small e (TB u k) /\ small (IZR (2 ^ (T o - K o))) (TM u k).

Lemma log2_bound x y : Z.abs x < 2 ^ bits (Z.lor (Z.abs x) (Z.abs y)) /\ Z.abs y < 2 ^ bits (Z.lor (Z.abs x) (Z.abs y)).
Proof.
  pose proof (log2_all x [x; y] ltac:(cbn; auto)) as A. pose proof (log2_all y [x; y] ltac:(cbn; auto)) as B.
  unfold length_of in A, B. cbn [fold_right] in A, B. rewrite Z.lor_0_r in A, B. unfold bits. auto.
Qed.
Definition inside x y := lo y <= lo x /\ hi x <= hi y.
Lemma hull_left a b x : inside x a -> inside x (hull a b).
Proof. unfold inside, hull; cbn. lia. Qed.
Lemma hull_right a b x : inside x b -> inside x (hull a b).
Proof. unfold inside, hull; cbn. lia. Qed.
Lemma inside_self x : inside x x.
Proof. unfold inside. lia. Qed.
Definition at_most e x := Z.abs (lo x) <= e /\ Z.abs (hi x) <= e.
Lemma hull_small e a b : at_most e a -> at_most e b -> at_most e (hull a b).
Proof. unfold at_most, hull; cbn. lia. Qed.
Lemma log2_small z n : 0 <= n -> Z.abs z <= 2 ^ n -> Z.log2 (Z.abs z) <= n.
Proof. intros Hn H. apply Z.log2_le_mono in H. now rewrite Z.log2_pow2 in H. Qed.
Lemma places_are l h T : 0 <= T -> Z.abs l <= 2 ^ T -> Z.abs h <= 2 ^ T -> exists L, 0 <= L <= T + 1 /\ Z.abs l < 2 ^ L /\ Z.abs h < 2 ^ L /\
  free_places (I l h) (T + 1) (T + 1) = T + 1 - L.
Proof.
  intros HT A B. destruct (log2_bound l h) as [L1 L2]. pose proof (log2_small _ _ HT A) as G1. pose proof (log2_small _ _ HT B) as G2.
  exists (bits (Z.lor (Z.abs l) (Z.abs h))).
  assert (HL : 0 <= bits (Z.lor (Z.abs l) (Z.abs h)) <= T + 1).
  { unfold bits. destruct (Z.eqb_spec (Z.lor (Z.abs l) (Z.abs h)) 0); [lia|]. pose proof (Z.log2_nonneg (Z.lor (Z.abs l) (Z.abs h))).
    rewrite Z.log2_lor in * by apply Z.abs_nonneg. lia. }
  repeat split; try tauto. unfold free_places; cbn [lo hi]. lia.
Qed.
Lemma scaled_small m n T y : 2 <= n -> n <= T -> at_most (2 ^ T) m -> encloses m y ->
  (Rabs (IZR (2 ^ free_places m (T + 1) (T + 1)) * part (T + 3 - n) * y) <= IZR (2 ^ (n - 2)))%R.
Proof.
  intros Hn HT [A B] [E1 E2]. destruct m as [l h]. cbn [lo hi] in *. destruct (places_are l h T ltac:(lia) A B) as (L & HL & L1 & L2 & ->).
  assert (Y : (Rabs y <= IZR (2 ^ L))%R).
  { assert (- 2 ^ L <= l /\ h <= 2 ^ L) as [K1 K2] by lia. apply IZR_le in K1, K2. rewrite opp_IZR in K1. apply Rabs_le. lra. }
  pose proof (part_pos (T + 3 - n)) as PP. assert (PK : 0 < 2 ^ (T + 1 - L)) by (apply Z.pow_pos_nonneg; lia). apply IZR_lt in PK.
  rewrite Rabs_mult, (Rabs_pos_eq (_ * part _)) by (apply Rmult_le_pos; lra).
  apply Rle_trans with (IZR (2 ^ (T + 1 - L)) * part (T + 3 - n) * IZR (2 ^ L))%R; [apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|exact Y]|].
  right. replace (IZR (2 ^ (T + 1 - L)) * part (T + 3 - n) * IZR (2 ^ L))%R with (IZR (2 ^ (T + 1 - L)) * IZR (2 ^ L) * part (T + 3 - n))%R by ring.
  rewrite <- mult_IZR, <- Z.pow_add_r by lia. replace (T + 1 - L + L) with ((n - 2) + (T + 3 - n)) by lia. rewrite Z.pow_add_r, mult_IZR by lia.
  rewrite Rmult_assoc, (Rmult_comm (IZR (2 ^ (T + 3 - n)))), part_pow by lia. ring.
Qed.
Lemma moved_small e x c : at_most e x -> Z.abs c <= e -> at_most (2 * e) (moved x c).
Proof. unfold at_most, moved; cbn [lo hi]. lia. Qed.
Lemma inside_encloses x y r : inside x y -> encloses x r -> encloses y r.
Proof. intros [A B] [C D]. apply IZR_le in A, B. unfold encloses. lra. Qed.
Lemma within_words_most o x k j : within_words o x = true -> at_most (2 ^ (T o - 1)) (x k j).
Proof.
  unfold within_words. rewrite every_all. intros H. specialize (H k). rewrite every_all in H. specialize (H j).
  apply andb_true_iff in H as [A B]. apply Z.leb_le in A, B. now split.
Qed.
Lemma normalised_small o a b j y : 2 <= N o -> N o <= T o -> renormalise o = true ->
  within_words o a = true -> within_words o b = true ->
  (exists x k, (x = a \/ x = b) /\ encloses (x k j) y) -> (Rabs (scale o a b j * (y - origin_of o a j)) <= IZR (2 ^ (N o - 2)))%R.
Proof.
  intros HN HT R WA WB (x & k & X & E). unfold scale, origin_of. rewrite R. unfold places_along. cbv zeta.
  pose proof (fun k => within_words_most o a k j WA) as A. pose proof (fun k => within_words_most o b k j WB) as B.
  apply scaled_small; auto.
  - replace (2 ^ T o) with (2 * 2 ^ (T o - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
    apply moved_small; [repeat apply hull_small; auto|apply (A T0)].
  - apply moved_encloses. eapply inside_encloses; [|exact E]. destruct X as [->| ->], k; eauto 6 using hull_left, hull_right, inside_self.
Qed.

Lemma extends_right o i u : valid o = true -> stands_for i u -> declared o i u ->
  extends (true_a o i u) (fst (extents o)) /\ extends (true_b o i u) (snd (extents o)).
Proof.
  intros V H D. unfold valid in V. rewrite !andb_true_iff, !Z.leb_le in V. destruct V as [[[[[P1 P2] P3] P4] P5] _].
  unfold declared in D. unfold extents. destruct (renormalise o) eqn:Rn.
  - destruct D as [WA WB]. cbn [fst snd].
    assert (E : IZR (2 ^ (N o - 1)) = (IZR (2 ^ (N o - 2)) + IZR (2 ^ (N o - 2)))%R).
    { rewrite <- plus_IZR. f_equal. replace (N o - 1) with (Z.succ (N o - 2)) by lia. rewrite Z.pow_succ_r by lia. lia. }
    assert (G : forall x y : R, (Rabs x <= IZR (2 ^ (N o - 2)) -> Rabs y <= IZR (2 ^ (N o - 2)) -> Rabs (x - y) <= IZR (2 ^ (N o - 1)))%R).
    { intros x y A B. rewrite E. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    split; intros k l j; apply G; unfold true_a, true_b; rewrite comp_to; apply normalised_small; auto.
    + exists (a_of o i), k. split; auto. unfold a_of. rewrite get_tab. apply reads_encloses. apply H.
    + exists (a_of o i), l. split; auto. unfold a_of. rewrite get_tab. apply reads_encloses. apply H.
    + exists (b_of o i), k. split; auto. unfold b_of. rewrite get_tab. apply placed_right; [lia|exact H].
    + exists (b_of o i), l. split; auto. unfold b_of. rewrite get_tab. apply placed_right; [lia|exact H].
  - assert (S : forall u j, comp (to o (a_of o i) (b_of o i) u) j = (part (T o - N o) * comp u j)%R) by (intros; rewrite comp_to; unfold scale, origin_of; rewrite Rn; ring).
    pose proof (part_pos (T o - N o)) as PP.
    assert (PN : (part (T o - N o) * IZR (2 ^ (T o - N o)) = 1)%R) by (apply part_pow; lia).
    assert (PW : forall e, N o >= e -> e >= 0 -> (part (T o - N o) * IZR (2 ^ (T o - e)) = IZR (2 ^ (N o - e)))%R).
    { intros e H1 H2. replace (T o - e) with ((N o - e) + (T o - N o)) by lia. rewrite Z.pow_add_r, mult_IZR by lia.
      replace (part (T o - N o) * (IZR (2 ^ (N o - e)) * IZR (2 ^ (T o - N o))))%R with (IZR (2 ^ (N o - e)) * (part (T o - N o) * IZR (2 ^ (T o - N o))))%R by ring. rewrite PN. ring. }
    assert (G : forall c e (x y : R), (part (T o - N o) * c = IZR e)%R -> (Rabs x <= c -> Rabs y <= c -> Rabs (part (T o - N o) * x - part (T o - N o) * y) <= IZR (2 * e))%R).
    { intros c e x y E A B. rewrite mult_IZR, <- E, <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq (part _)) by lra.
      replace (2 * (part (T o - N o) * c))%R with (part (T o - N o) * (2 * c))%R by ring. apply Rmult_le_compat_l; [lra|].
      unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    unfold true_a, true_b, true_placed. destruct (frame o); cbn [fst snd].
    + assert (E : (part (T o - N o) * IZR (2 ^ (T o - 1) - 2 * 2 ^ (T o - N o)) = IZR (2 ^ (N o - 1) - 2))%R).
      { rewrite !minus_IZR, mult_IZR, Rmult_minus_distr_l, PW by lia. replace (part (T o - N o) * (2 * IZR (2 ^ (T o - N o))))%R with (2 * (part (T o - N o) * IZR (2 ^ (T o - N o))))%R by ring. rewrite PN. ring. }
      split; intros k l j; rewrite !S; apply (G _ _ _ _ E); apply D.
    + pose proof (PW (K o) ltac:(lia) ltac:(lia)) as E. split; intros k l j; rewrite !S; [apply (G _ _ _ _ E); apply D|].
      destruct (bypass i); [apply (G _ _ _ _ E); apply D|].
      replace (part (T o - N o) * comp (plus (TB u k) (Tt u)) j - part (T o - N o) * comp (plus (TB u l) (Tt u)) j)%R with
        (part (T o - N o) * comp (TB u k) j - part (T o - N o) * comp (TB u l) j)%R by (destruct j; cbn; ring). apply (G _ _ _ _ E); apply D.
    + pose proof (PW (K o) ltac:(lia) ltac:(lia)) as E. split; intros k l j; rewrite !S; [apply (G _ _ _ _ E); apply D|].
      set (f := IZR (2 ^ (T o - K o))) in *. assert (PF : (0 < f)%R) by (apply IZR_lt, Z.pow_pos_nonneg; lia).
      assert (Pf : (part (T o - K o) * f = 1)%R) by (apply part_pow; lia). pose proof (part_pos (T o - K o)) as PP'.
      assert (Six : IZR (6 * 2 ^ (N o - K o)) = (6 * (part (T o - N o) * f))%R) by (rewrite mult_IZR, <- E; ring).
      destruct (bypass i).
      { eapply Rle_trans; [apply (G _ _ _ _ E); apply D|]. rewrite Six, mult_IZR, <- E. assert (0 < part (T o - N o) * f)%R by (apply Rmult_lt_0_compat; lra). lra. }
      set (d := minus (TB u k) (TB u l)).
      replace (part (T o - N o) * comp (plus (V3 (dot (TM u T0) (TB u k) * part (T o - K o)) (dot (TM u T1) (TB u k) * part (T o - K o)) (dot (TM u T2) (TB u k) * part (T o - K o))) (Tt u)) j -
        part (T o - N o) * comp (plus (V3 (dot (TM u T0) (TB u l) * part (T o - K o)) (dot (TM u T1) (TB u l) * part (T o - K o)) (dot (TM u T2) (TB u l) * part (T o - K o))) (Tt u)) j)%R with
        (part (T o - N o) * (part (T o - K o) * dot (TM u j) d))%R by (unfold d, dot, minus; destruct j; cbn; ring).
      assert (B : (Rabs (dot (TM u j) d) <= 6 * f * f)%R).
      { assert (Dd : within (2 * f) d).
        { assert (T2f : forall c, (Rabs (comp d c) <= 2 * f)%R).
          { intros c. unfold d. rewrite comp_minus. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
            destruct (D k) as (_ & D1 & _), (D l) as (_ & D2 & _). pose proof (D1 c). pose proof (D2 c). lra. }
          repeat split; [apply (T2f T0)|apply (T2f T1)|apply (T2f T2)]. }
        replace (dot (TM u j) d) with (dot d (TM u j)) by (unfold dot; ring). eapply Rle_trans; [apply (dot_bound _ _ _ Dd)|].
        assert (Nm : (norm (TM u j) <= 3 * f)%R).
        { destruct (D j) as (_ & _ & D3). unfold norm. pose proof (D3 T0). pose proof (D3 T1). pose proof (D3 T2). cbn in *. lra. }
        pose proof (norm_pos (TM u j)). nra. }
      rewrite !Rabs_mult, (Rabs_pos_eq (part (T o - N o))), (Rabs_pos_eq (part (T o - K o))) by lra. rewrite Six.
      replace (6 * (part (T o - N o) * f))%R with (part (T o - N o) * (part (T o - K o) * (6 * f * f)))%R.
      * apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; [lra|exact B].
      * transitivity (part (T o - N o) * (6 * f) * (part (T o - K o) * f))%R; [ring|]. rewrite Pf. ring.
Qed.

(** * The theorem *)
(** A table in which no number is saturated needs no range. *)
Definition no_saturation o : bool := (0 <=? axis_places o) && (0 <=? K o) && (K o <=? T o) &&
  every (fun k => unsaturated (saturated (edge_a o k))) && unsaturated (saturated (edge_b o)) && unsaturated (saturated (normal_a o)) && unsaturated (saturated (normal_b o))
  && every (fun k => unsaturated (saturated (cross_a o k))) && every (fun k => unsaturated (saturated (in_plane_a o k))) && unsaturated (saturated (in_plane_b o)).
Theorem axis_unit_is_right o i u : no_saturation o = true \/ (valid o = true /\ declared o i u) -> stands_for i u ->
  says (verdict (unit o i)) (common (place_of (TA u T0)) (place_of (TA u T1)) (place_of (TA u T2))
    (place_of (true_placed o i u T0)) (place_of (true_placed o i u T1)) (place_of (true_placed o i u T2))).
Proof.
  intros [V|[V D]] H.
  - unfold no_saturation in V. rewrite !andb_true_iff, !Z.leb_le, !every_all in V. destruct V as [[[[[[[[[V1 V2] V3] S1] S2] S3] S4] S5] S6] S7].
    apply unit_right; auto. apply unsaturated_none in S2, S3, S4, S7. unfold saturation_holds. rewrite S2, S3, S4, S7.
    split; [intros k j; rewrite (unsaturated_none _ (S1 k)); exact Logic.I|]. split; [intros; exact Logic.I|].
    split; [destruct (axis_places o =? 0); split; auto; intros; exact Logic.I|]. split; [intros; now apply unsaturated_none|]. split; [intros; now apply unsaturated_none|auto].
  - pose proof (extends_right o i u V H D) as [Ea Eb]. unfold valid in V. rewrite !andb_true_iff, !Z.leb_le in V. destruct V as [[[[[V1 V2] V3] V4] V5] V6].
    apply unit_right; auto; [lia|]. exact (saturation_right _ _ _ _ _ V6 Ea Eb).
Qed.

(** * The guard *)
(** Lemma guard: with a bound t = 2^d h, a word x and a sticky bit s (0 or 1), what the entity compares says whether x and x + s
    are within the bound. *)
Theorem guard_keeps d h x s : 0 <= d -> 1 <= h -> s = 0 \/ s = 1 -> let q := x / 2 ^ d in let r := x mod 2 ^ d in
  (- (2 ^ d * h) <= x /\ x + s <= 2 ^ d * h) <-> ~ (q > h \/ q < - h \/ (q = h /\ (r <> 0 \/ s <> 0))).
Proof.
  intros Hd Hh Hs q r. assert (P : 0 < 2 ^ d) by (apply Z.pow_pos_nonneg; lia).
  pose proof (Z.div_mod x (2 ^ d) ltac:(lia)) as E. pose proof (Z.mod_pos_bound x (2 ^ d) P) as M. fold q r in E, M. split.
  - intros [A B] [C|[C|[C1 C2]]]; nia.
  - intros C. assert (C' : - h <= q <= h /\ (q = h -> r = 0 /\ s = 0)) by lia. destruct C' as [[C1 C2] C3]. destruct (Z.eq_dec q h) as [->|]; [destruct (C3 eq_refl); nia|nia].
Qed.
(** What goes on instead of a word that is outside. *)
Theorem guard_replaces e t x s : 0 <= e -> 2 ^ e <= t -> s = 0 \/ s = 1 -> 0 <= x mod 2 ^ e /\ x mod 2 ^ e + s <= t.
Proof. intros He Ht Hs. pose proof (Z.mod_pos_bound x (2 ^ e) ltac:(apply Z.pow_pos_nonneg; lia)). lia. Qed.
(** A word whose floor, and ceiling by its sticky bit, are within a bound stands for numbers within it. *)
Theorem kept_words_are_declared t w x : word_of w x -> - t <= fst w -> fst w + (if snd w then 1 else 0) <= t -> (Rabs x <= IZR t)%R.
Proof.
  intros [[A B] C] L U. apply IZR_le in L, U. rewrite opp_IZR in L. rewrite plus_IZR in U. apply Rabs_le.
  destruct (snd w); [lra|]. rewrite (C eq_refl) in *. lra.
Qed.

(** * Formats *)
(** Lemma axis-shift: an axis component that is shifted by s before n bits are dropped has n bits, if the one that is not shifted
    has n - s. *)
Lemma floor_times x n s : 0 <= n -> 0 <= s -> Z.shiftr x n * 2 ^ s <= Z.shiftr (x * 2 ^ s) n <= (Z.shiftr x n + 1) * 2 ^ s - 1.
Proof.
  intros Hn Hs. rewrite !Z.shiftr_div_pow2 by lia. assert (P : 0 < 2 ^ n) by (apply Z.pow_pos_nonneg; lia). assert (Q : 0 < 2 ^ s) by (apply Z.pow_pos_nonneg; lia).
  pose proof (Z.mul_div_le x (2 ^ n) P). pose proof (Z.mul_succ_div_gt x (2 ^ n) P). set (r := x / 2 ^ n) in *. split.
  - apply Z.div_le_lower_bound; nia.
  - enough (x * 2 ^ s / 2 ^ n < (r + 1) * 2 ^ s) by lia. apply Z.div_lt_upper_bound; nia.
Qed.
Theorem shifted_axis_fits n x u s : 0 <= s <= n - 1 -> let R := 2 ^ (n - 1) in
  (Z.abs (Z.shiftr x n) * 2 ^ s < R -> Z.abs (Z.shiftr (x * 2 ^ s) n) <= R - 1) /\
  (Z.abs (raised (Some u) x n) * 2 ^ s < R -> Z.abs (raised (Some u) (x * 2 ^ s) n) <= R - 1).
Proof.
  intros Hs R. assert (Q : 0 < 2 ^ s) by (apply Z.pow_pos_nonneg; lia).
  assert (E : R = 2 ^ (n - 1 - s) * 2 ^ s) by (unfold R; rewrite <- Z.pow_add_r by lia; f_equal; lia).
  set (k := 2 ^ (n - 1 - s)) in *. clearbody R k. subst R.
  assert (B : forall r, Z.abs r * 2 ^ s < k * 2 ^ s -> Z.abs r <= k - 1) by (intros r H; apply Z.mul_lt_mono_pos_r in H; lia).
  assert (F : forall y, Z.abs (Z.shiftr y n) * 2 ^ s < k * 2 ^ s -> Z.abs (Z.shiftr (y * 2 ^ s) n) <= k * 2 ^ s - 1).
  { intros y H. apply B in H. pose proof (floor_times y n s ltac:(lia) ltac:(lia)). nia. }
  split; [apply F|]. destruct u; cbn [raised].
  - rewrite !Z.abs_opp. replace (- (x * 2 ^ s)) with (- x * 2 ^ s) by ring. apply F.
  - destruct (Z.ltb_spec 0 n) as [Hn|Hn]; [|apply F]. intros H. apply B in H. pose proof (floor_times x n s ltac:(lia) ltac:(lia)). nia.
Qed.
(** Lemma normalise, (d): a coordinate x with |x| < 2^L is within [-1, 1] behind the scale, in steps of 2^-f. *)
Theorem normalised_fits x L f : 0 <= L -> 0 <= f -> Z.abs x < 2 ^ L -> - 2 ^ f <= x * 2 ^ f / 2 ^ L /\ x * 2 ^ f / 2 ^ L + 1 <= 2 ^ f.
Proof.
  intros HL Hf H. assert (P : 0 < 2 ^ L) by (apply Z.pow_pos_nonneg; lia). assert (Q : 0 < 2 ^ f) by (apply Z.pow_pos_nonneg; lia). split.
  - apply Z.div_le_lower_bound; nia.
  - enough (x * 2 ^ f / 2 ^ L < 2 ^ f) by lia. apply Z.div_lt_upper_bound; nia.
Qed.

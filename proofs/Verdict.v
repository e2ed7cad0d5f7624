(** The verdict of the determinant unit from signs of which each is right or 0, section 6 of docs/determinants.md: `separate` is
    right ([separate_sound]), and so is `intersect` ([intersect_sound]). *)
From Coq Require Import List Bool PArith ZArith Ring Lia.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.Space Efsat.Five Efsat.Axes.
Import ListNotations.

Definition one_side (f : positive -> sign) (vs : list positive) : bool := forallb (fun v => seq (f v) P) vs || forallb (fun v => seq (f v) N) vs.
Definition says_separate f : bool := one_side f [1; 2; 3]%positive || one_side f [4; 5; 6]%positive
  || Nat.leb 5 (length (filter (at_edge misses f) edge_list)).
Definition says_intersect f : bool := negb (says_separate f) && existsb (at_edge pierces f) edge_list.

Definition certain (c f : positive -> sign) : Prop := forall v, c v = O \/ c v = f v.
Lemma sides_certain g c f e : (forall p q s0 s1 s2 p' q' s0' s1' s2', g p q s0 s1 s2 = true -> (p = O \/ p = p') -> (q = O \/ q = q') ->
  (s0 = O \/ s0 = s0') -> (s1 = O \/ s1 = s1') -> (s2 = O \/ s2 = s2') -> g p' q' s0' s1' s2' = true) ->
  certain c f -> at_edge g c e = true -> at_edge g f e = true.
Proof. intros M C. destruct e as [b [[[[p q] s0] s1] s2]]. cbn. intros H. eapply M; eauto. Qed.
Lemma misses_certain c f e : certain c f -> at_edge misses c e = true -> at_edge misses f e = true.
Proof.
  apply sides_certain. intros p q s0 s1 s2 p' q' s0' s1' s2' H A B K L M.
  unfold misses in *. rewrite orb_true_iff, andb_true_iff, !orb_true_iff, !seq_eq in *.
  destruct H as [H|[H1 H2]]; [left; clear - H A B; destruct p, q, p', q'; cbn in *; intuition congruence|right].
  split; [destruct H1 as [[->| ->]| ->]|destruct H2 as [[->| ->]| ->]]; intuition congruence.
Qed.
Lemma pierces_hits c f e : certain c f -> at_edge pierces c e = true -> at_edge hits f e = true.
Proof.
  intros C H. destruct e as [b [[[[p q] s0] s1] s2]]. cbn in *.
  assert (E : forall v, c v <> O -> f v = c v) by (intros v Hv; destruct (C v); congruence).
  unfold pierces in H. rewrite andb_true_iff, orb_true_iff, !andb_true_iff, !seq_eq in H.
  destruct H as [H [[[A B] D]|[[A B] D]]]; rewrite (E s0), (E s1), (E s2) by congruence; rewrite A, B, D;
  (assert (c p <> O) by (intros X; rewrite X in H; discriminate)); (assert (c q <> O) by (intros X; rewrite X in H; destruct (c p); discriminate));
  rewrite (E p), (E q) by auto; destruct (c p), (c q); cbn in *; congruence.
Qed.

Module Verdict (D : DOM).
  Module A := Axes D.
  Import D A A.S A.S.F.
  Local Open Scope dom.

  Lemma weighted x y z a b c : sg x <> N -> sg y <> N -> sg z <> N -> sg (x + y + z) = P ->
    sg a = P -> sg b = P -> sg c = P -> sg (x * a + y * b + z * c) = P.
  Proof.
    intros X Y Z S A B K. replace (x * a + y * b + z * c) with (sum [x * a; y * b; z * c]) by (cbn; ring).
    assert (E : forall t, smul t P = t) by now intros [].
    apply sum_ge; [repeat constructor; rewrite sg_mul, ?A, ?B, ?K, E; auto|].
    repeat rewrite Exists_cons. rewrite !sg_mul, A, B, K, !E, Exists_nil.
    destruct (sg x) eqn:?, (sg y) eqn:?, (sg z) eqn:?; auto; try congruence.
    exfalso. rewrite sg_zero in *. subst. replace (0 + 0 + 0) with 0 in S by ring. rewrite sg0 in S. discriminate.
  Qed.
  Lemma weighted_not_zero x y z a b c s : sg x <> N -> sg y <> N -> sg z <> N -> sg (x + y + z) = P -> s <> O ->
    sg a = s -> sg b = s -> sg c = s -> x * a + y * b + z * c = 0 -> False.
  Proof.
    intros X Y Z S NZ A B K E. destruct s; [|tauto|].
    - assert (T : sg (x * - a + y * - b + z * - c) = P) by (apply weighted; auto; rewrite sg_opp, ?A, ?B, ?K; reflexivity).
      replace (x * - a + y * - b + z * - c) with (- (x * a + y * b + z * c)) in T by ring. rewrite E, sg_opp, sg0 in T. discriminate.
    - assert (T : sg (x * a + y * b + z * c) = P) by (apply weighted; auto). rewrite E, sg0 in T. discriminate.
  Qed.
  Lemma one_side_sign (f : positive -> sign) u v w : one_side f [u; v; w] = true -> exists s, s <> O /\ f u = s /\ f v = s /\ f w = s.
  Proof.
    unfold one_side. cbn. rewrite orb_true_iff, !andb_true_iff, !seq_eq. intros [(A & B & K & _)|(A & B & K & _)]; [exists P|exists N]; repeat split; auto; discriminate.
  Qed.

  Section Pair.
    Variables v1 v2 w0 w1 w2 : vec.
    Let f := sign_of (fifteen v1 v2 w0 w1 w2).
    Variable c : positive -> sign.
    Hypothesis C : certain c f.

    Theorem separate_sound : says_separate c = true -> ~ meet origin v1 v2 w0 w1 w2.
    Proof.
      intros H M. unfold says_separate in H. rewrite !orb_true_iff in H.
      assert (E : forall v, c v <> O -> f v = c v) by (intros v Hv; destruct (C v); congruence).
      destruct H as [[H|H]|H].
      - destruct M as (x0 & x1 & x2 & x3 & x4 & x5 & M). apply one_side_sign in H as (s & Hs & A1 & A2 & A3).
        pose proof (functional _ _ _ _ _ _ _ _ _ _ _ M (cross v1 v2) 0) as V. destruct M as (_ & S & G & K).
        repeat rewrite Forall_cons_iff in G. destruct G as (G0 & G1 & G2 & G3 & G4 & G5 & _). rewrite S in K.
        refine (weighted_not_zero x3 x4 x5 (dot (cross v1 v2) w0) (dot (cross v1 v2) w1) (dot (cross v1 v2) w2) s G3 G4 G5 K Hs _ _ _ _).
        + change (f 1%positive = s). rewrite E; congruence. + change (f 2%positive = s). rewrite E; congruence. + change (f 3%positive = s). rewrite E; congruence.
        + transitivity (- value v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 (cross v1 v2) 0); [unfold value, dot, cross; cbn; ring|rewrite V; ring].
      - destruct M as (x0 & x1 & x2 & x3 & x4 & x5 & M). apply one_side_sign in H as (s & Hs & A1 & A2 & A3).
        pose proof (functional _ _ _ _ _ _ _ _ _ _ _ M (cross (minus w1 w0) (minus w2 w0)) (- dot (cross (minus w1 w0) (minus w2 w0)) w0)) as V. destruct M as (_ & S & G & K).
        repeat rewrite Forall_cons_iff in G. destruct G as (G0 & G1 & G2 & G3 & G4 & G5 & _).
        refine (weighted_not_zero x0 x1 x2 (pick (fifteen v1 v2 w0 w1 w2) 4) (pick (fifteen v1 v2 w0 w1 w2) 5) (pick (fifteen v1 v2 w0 w1 w2) 6) s G0 G1 G2 K Hs _ _ _ _).
        + change (f 4%positive = s). rewrite E; congruence. + change (f 5%positive = s). rewrite E; congruence. + change (f 6%positive = s). rewrite E; congruence.
        + transitivity (- value v1 v2 w0 w1 w2 x0 x1 x2 x3 x4 x5 (cross (minus w1 w0) (minus w2 w0)) (- dot (cross (minus w1 w0) (minus w2 w0)) w0));
            [unfold value, dot, cross, minus; cbn; unfold dot, cross; cbn; ring|rewrite V; ring].
      - (* Five edges. *)
        assert (K : exists k, (k < 6)%nat /\ forallb (at_edge misses c) (without k) = true).
        { revert H. unfold edge_list, without, skipn, firstn, edge_list. cbn [filter].
          generalize (at_edge misses c). intros g. unfold filter, forallb, app.
          repeat match goal with |- context [if g ?e then _ else _] => destruct (g e) eqn:? end; cbn; intros X; try discriminate;
          [exists 0%nat|exists 5%nat|exists 4%nat|exists 3%nat|exists 2%nat|exists 1%nat|exists 0%nat]; split; try lia; repeat match goal with E : _ = true |- _ => rewrite E end; reflexivity. }
        destruct K as (k & Hk & K). rewrite forallb_forall in K.
        assert (NZ : ~ Forall (fun v => f v = O) determinants).
        { intros Z0. assert (K' : forall e, In e (without k) -> at_edge misses f e = true) by (intros e I; eapply misses_certain; eauto).
          unfold determinants in Z0. repeat rewrite Forall_cons_iff in Z0.
          destruct Z0 as (Z1 & Z2 & Z3 & Z4 & Z5 & Z6 & Z7 & Z8 & Z9 & Z10 & Z11 & Z12 & Z13 & Z14 & Z15 & _).
          assert (X : forall e, In e edge_list -> at_edge misses f e = false).
          { intros e I. unfold edge_list in I. cbn [In] in I. repeat destruct I as [<-|I]; try destruct I; cbn;
            rewrite ?Z1, ?Z2, ?Z3, ?Z4, ?Z5, ?Z6, ?Z7, ?Z8, ?Z9, ?Z10, ?Z11, ?Z12, ?Z13, ?Z14, ?Z15; reflexivity. }
          assert (W : exists e, In e (without k) /\ In e edge_list).
          { clear - Hk. do 6 (destruct k as [|k]; [eexists; split; [cbn; left; reflexivity|cbn; tauto]|]). lia. }
          destruct W as (e & I1 & I2). pose proof (K' e I1) as Q. rewrite (X e I2) in Q. discriminate. }
        pose proof (two_hit _ _ _ _ _ M NZ k Hk) as T. fold f in T. apply existsb_exists in T as (e & I & T).
        pose proof (misses_certain _ _ _ C (K e I)) as X. destruct e as [b [[[[p q] s0] s1] s2]]. cbn in T, X. unfold hits in T. rewrite X in T. discriminate.
    Qed.

    Theorem intersect_sound : says_intersect c = true -> meet origin v1 v2 w0 w1 w2.
    Proof.
      unfold says_intersect. rewrite andb_true_iff, existsb_exists. intros [_ (e & I & H)]. apply hits_common. apply existsb_exists. exists e. split; auto.
      exact (pierces_hits _ _ _ C H).
    Qed.
  End Pair.
End Verdict.
Module OnReals := Verdict RealNumbers.
Module OnIntegers := Verdict Integers.

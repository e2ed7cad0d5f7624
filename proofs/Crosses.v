(** Whether an exact pair crosses, sections 4 and 5 of docs/exact.md: if and only if the relative interiors of the two triangles have a
    common point, degenerate and coplanar ones included ([crosses_right]).

    A point is in the relative interior if all its weights can be positive. Weights of several common points may be added: so it is enough
    that each of the six points has a positive weight in some common point. *)
From Coq Require Import List Bool PArith ZArith Ring Lia.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.PlaneTable Efsat.CrossTable Efsat.Space Efsat.Plane Efsat.Exact.
Import ListNotations.

Module Crosses (D : DOM).
  Module E := Exact D.
  Module L := E.L.
  Import D E.S.F E.S E.
  Local Open Scope dom.

  (** * Weights *)
  Definition balance v0 v1 v2 w0 w1 w2 (x : nat -> C) : Prop :=
    combine (x 0%nat) (x 1%nat) (x 2%nat) v0 v1 v2 = combine (x 3%nat) (x 4%nat) (x 5%nat) w0 w1 w2 /\
    x 0%nat + x 1%nat + x 2%nat = x 3%nat + x 4%nat + x 5%nat.
  Definition all_positive (x : nat -> C) : Prop := forall i, (i < 6)%nat -> sg (x i) = P.
  (** A common point of the relative interiors. *)
  Definition cross_ v0 v1 v2 w0 w1 w2 : Prop := exists x, balance v0 v1 v2 w0 w1 w2 x /\ all_positive x.

  Section Gather.
    Variable solves : (nat -> C) -> Prop.
    Hypothesis Add : forall x y, solves x -> solves y -> solves (fun i => x i + y i).
    Definition reaches (i : nat) := exists x, solves x /\ (forall j, sg (x j) <> N) /\ sg (x i) = P.
    Lemma gather : (forall i, (i < 6)%nat -> reaches i) -> exists x, solves x /\ all_positive x.
    Proof.
      intros R. assert (G : forall n, (n < 6)%nat -> exists x, solves x /\ (forall j, sg (x j) <> N) /\ forall j, (j <= n)%nat -> sg (x j) = P).
      { induction n as [|n IH]; intros B.
        - destruct (R 0%nat B) as (x & Sx & G & K). exists x. repeat split; auto. intros j J. now replace j with 0%nat by lia.
        - destruct IH as (x & Sx & G & K); [lia|]. destruct (R (S n) B) as (y & Sy & G' & K').
          exists (fun i => x i + y i). split; [auto|]. split; [intros j; apply ge_add; auto|].
          intros j J. destruct (Nat.eq_dec j (S n)) as [->|NE].
          + apply sg_add; auto.
          + replace (x j + y j) with (y j + x j) by ring. apply sg_add; auto. apply K. lia. }
      destruct (G 5%nat) as (x & Sx & _ & K); [lia|]. exists x. split; auto. intros j J. apply K. lia.
    Qed.
  End Gather.
  Lemma added a b c a' b' c' : a = b -> a' = b' -> c = a + a' -> c' = b + b' -> c = c'.
  Proof. intros; subst; reflexivity. Qed.
  Lemma balance_add v0 v1 v2 w0 w1 w2 x y : balance v0 v1 v2 w0 w1 w2 x -> balance v0 v1 v2 w0 w1 w2 y -> balance v0 v1 v2 w0 w1 w2 (fun i => x i + y i).
  Proof.
    unfold balance, combine. intros [A B] [A' B']. injection A as A1 A2 A3. injection A' as A1' A2' A3'.
    split; [f_equal; [apply (added _ _ _ _ _ _ A1 A1')|apply (added _ _ _ _ _ _ A2 A2')|apply (added _ _ _ _ _ _ A3 A3')]|apply (added _ _ _ _ _ _ B B')]; ring.
  Qed.

  (** Weights by signed variables. *)
  Definition weight (g : positive -> C) (m : bool) (c : list (option signed)) (j : nat) : C :=
    match nth j c None with Some (b, v) => if xorb b m then - g v else g v | None => 0 end.
  Lemma strict_weights g i m c p : In p (strict_at i m c) -> holds (fun v => sg (g v)) p = true ->
    (forall j, sg (weight g m c j) <> N) /\ sg (weight g m c i) = P.
  Proof.
    unfold strict_at, weight. intros I H. destruct (nth i c None) as [[b v]|] eqn:Ei; [|destruct I]. destruct I as [<-|[]].
    change (mem (sg (g v)) (strict (xorb b m)) && holds (fun v => sg (g v)) (all_weak m (somes c)) = true)%bool in H.
    apply andb_true_iff in H as [H A]. apply all_weak_holds in A. rewrite Forall_forall in A. split.
    - intros j. destruct (nth j c None) as [[b' v']|] eqn:Ej; [|rewrite sg0; discriminate].
      assert (J : In (nth j c None) c) by (apply nth_In; destruct (Nat.lt_ge_cases j (length c)); auto; rewrite nth_overflow in Ej by auto; discriminate).
      rewrite Ej in J. assert (J' : In (b', v') (somes c)) by (unfold somes; apply in_flat_map; exists (Some (b', v')); split; [exact J|now left]).
      specialize (A _ J'). cbn in A. destruct (xorb b' m); auto. now rewrite sg_opp.
    - destruct (xorb b m); rewrite ?sg_opp; cbn in H; destruct (sg (g v)); cbn in *; congruence.
  Qed.
  Lemma positive_at_weights g (solves : (nat -> C) -> Prop) i cs p : In p (positive_at i cs) -> holds (fun v => sg (g v)) p = true ->
    (forall c m, In c cs -> solves (weight g m c)) -> reaches solves i.
  Proof.
    unfold positive_at. intros I H A. apply in_flat_map in I as (c & J & I). apply in_app_iff in I as [I|I];
    destruct (strict_weights _ _ _ _ _ I H) as [G K]; [exists (weight g false c)|exists (weight g true c)]; auto.
  Qed.

  (** * Not in one plane *)
  Section Outside.
    Variables v1 v2 w0 w1 w2 : vec.
    Let l := fifteen v1 v2 w0 w1 w2.
    Let f := sign_of l.

    Lemma circuit_balance c m : In c circuits -> balance origin v1 v2 w0 w1 w2 (weight (pick l) m c).
    Proof.
      unfold circuits. intros H. unfold balance, weight, l, fifteen. cbn [In] in H.
      repeat destruct H as [<-|H]; try destruct H; destruct m; cbn -[dot cross]; unfold combine, origin, dot, cross; cbn; (split; [f_equal; ring|ring]).
    Qed.
    Definition term_value (g : positive -> C) (m : bool) (t : signed) : C := let '(b, v) := t in if xorb b m then - g v else g v.
    Lemma term_value_sign g m t : sg (term_value g m t) = signed_sign (fun v => sg (g v)) m t.
    Proof. destruct t as [b v]. cbn. destruct (xorb b m); auto. apply sg_opp. Qed.
    Lemma no_strict_sum g m ts p : sum (map (term_value g m) ts) = 0 -> In p (some_strict m ts) -> holds (fun v => sg (g v)) p = true -> False.
    Proof.
      intros S I H. destruct (some_strict_holds _ _ _ _ I H) as [G E]. destruct (sum_ge (map (term_value g m) ts)) as [_ K].
      - apply Forall_map. revert G. apply Forall_impl. intros t. now rewrite term_value_sign.
      - rewrite S, sg0 in K. apply Exists_exists in E as (t & It & E). enough (O = P) by discriminate. apply K.
        apply Exists_exists. exists (term_value g m t). split; [now apply in_map|]. now rewrite term_value_sign.
    Qed.
    Lemma five_sums r m t : In t five_terms -> sum (map (term_value (pick (l ++ r)) m) t) = 0.
    Proof.
      unfold five_terms, edge_list, l, fifteen. cbn [map In negb]. intros H.
      repeat destruct H as [<-|H]; try destruct H; destruct m; cbn -[dot cross]; ring.
    Qed.
    Lemma no_five r p : In p (flat_map (fun t => some_strict false t ++ some_strict true t) five_terms) ->
      holds (sign_of (l ++ r)) p = true -> False.
    Proof.
      intros I H. apply in_flat_map in I as (t & It & I). apply in_app_iff in I as [I|I]; (eapply no_strict_sum; [|exact I|exact H]); now apply five_sums.
    Qed.
    Lemma no_chirotope p : In p chirotope -> holds f p = true -> False.
    Proof.
      unfold chirotope. intros I H. apply in_app_iff in I as [I|I].
      - exact (zero_sums (pick l) _ _ (pluecker_holds _ _ _ _ _) I H).
      - apply (no_five [] p I). now rewrite app_nil_r.
    Qed.

    Lemma pierce_pattern p : In p all_pierce -> holds f p = true -> existsb (at_edge pierces f) edge_list = true.
    Proof.
      unfold all_pierce. intros I H. apply in_flat_map in I as (e & Ie & I). apply existsb_exists. exists e. split; auto.
      destruct e as [b [[[[p' q] s0] s1] s2]]. cbn in *.
      repeat destruct I as [<-|I]; try destruct I; cbn in H; destruct (f p'); try discriminate H; destruct (f q); try discriminate H;
      destruct (f s0); try discriminate H; destruct (f s1); try discriminate H; destruct (f s2); try discriminate H; reflexivity.
    Qed.
    Lemma pierces_pattern e : In e edge_list -> at_edge pierces f e = true -> exists p, In p all_pierce /\ holds f p = true.
    Proof.
      intros Ie H. assert (G : exists p, In p (pierce_patterns e) /\ holds f p = true).
      { destruct e as [b [[[[p' q] s0] s1] s2]]. cbn in *. unfold pierces in H.
        destruct (f p') eqn:Ep, (f q) eqn:Eq, (f s0) eqn:E0, (f s1) eqn:E1, (f s2) eqn:E2; cbn in H; try discriminate;
        first [exists [(p', pos); (q, neg); (s0, pos); (s1, pos); (s2, pos)]; split; [cbn; tauto|cbn; now rewrite Ep, Eq, E0, E1, E2]
          |exists [(p', pos); (q, neg); (s0, neg); (s1, neg); (s2, neg)]; split; [cbn; tauto|cbn; now rewrite Ep, Eq, E0, E1, E2]
          |exists [(p', neg); (q, pos); (s0, pos); (s1, pos); (s2, pos)]; split; [cbn; tauto|cbn; now rewrite Ep, Eq, E0, E1, E2]
          |exists [(p', neg); (q, pos); (s0, neg); (s1, neg); (s2, neg)]; split; [cbn; tauto|cbn; now rewrite Ep, Eq, E0, E1, E2]]. }
      destruct G as (p & I & G). exists p. split; auto. apply in_flat_map. eauto.
    Qed.

    Lemma all_six : (forall i, (i < 6)%nat -> exists p, In p (positive_at i circuits) /\ holds f p = true) -> cross_ origin v1 v2 w0 w1 w2.
    Proof.
      intros A. apply gather; [apply balance_add|]. intros i Hi. destruct (A i Hi) as (p & I & H).
      apply (positive_at_weights (pick l) _ _ _ _ I H). intros c m Ic. now apply circuit_balance.
    Qed.
    Lemma in_six i : (i < 6)%nat -> In i six.
    Proof. intros. unfold six. apply in_seq. lia. Qed.

    Lemma piercing_sound : existsb (at_edge pierces f) edge_list = true -> cross_ origin v1 v2 w0 w1 w2.
    Proof.
      intros H. apply existsb_exists in H as (e & Ie & H). destruct (pierces_pattern e Ie H) as (x & Ix & Hx).
      apply all_six. intros i Hi. pose proof piercing_refuted as R. rewrite forallb_forall in R. specialize (R x Ix).
      rewrite forallb_forall in R. specialize (R i (in_six i Hi)).
      destruct (refuted_sound _ _ R f) as (p & I & Hp). rewrite !in_app_iff in I. destruct I as [I|[I|I]]; [destruct (no_chirotope p I Hp)| |eauto].
      exfalso. unfold denied in I. apply in_map_iff in I as ([v a] & <- & I). cbn in Hp. rewrite andb_true_r in Hp.
      unfold holds in Hx. rewrite forallb_forall in Hx. specialize (Hx _ I). cbn in Hx. clear - Hx Hp. destruct (f v), a; cbn in *; rewrite Hx in Hp; discriminate.
    Qed.

    Lemma one_sided_not vs p : In p (one_sided vs) -> holds f p = true -> straddles f vs = false.
    Proof.
      intros I H. unfold straddles. assert (G : forall s t, (forall v, In v vs -> mem (f v) s = true) -> mem t s = false -> existsb (fun v => seq (f v) t) vs = false).
      { intros s t A B. destruct (existsb _ vs) eqn:E; auto. apply existsb_exists in E as (v & Iv & E). apply seq_eq in E. specialize (A v Iv). congruence. }
      assert (K : forall s, holds f (map (fun v => (v, s)) vs) = true -> forall v, In v vs -> mem (f v) s = true).
      { intros s Hs v Iv. unfold holds in Hs. rewrite forallb_forall in Hs. exact (Hs (v, s) (in_map (fun v => (v, s)) _ _ Iv)). }
      destruct I as [<-|[<-|[]]].
      - rewrite (G ge N (K ge H) eq_refl). apply andb_false_r.
      - now rewrite (G le P (K le H) eq_refl).
    Qed.
    Lemma no_pass t p : In p (no_pass_patterns t) -> holds f p = true -> passes_at f t = false.
    Proof.
      destruct t as [[a b] s]. cbn. intros I H. repeat destruct I as [<-|I]; try destruct I; cbn in H; destruct (f a), (f b), (f s); cbn in *; congruence.
    Qed.
    Lemma no_way_not k p : In p (no_way k) -> holds f p = true -> existsb (passes_at f) (through k) = false.
    Proof.
      unfold no_way. generalize (through k). intros ts. revert p. induction ts as [|t ts IH]; cbn [fold_right existsb]; intros p I H; auto.
      destruct (holds_both _ _ _ _ I H) as [(x & Ix & Hx) (y & Iy & Hy)]. now rewrite (no_pass _ _ Ix Hx), (IH _ Iy Hy).
    Qed.

    Lemma outside_sound : crosses_outside f = true -> cross_ origin v1 v2 w0 w1 w2.
    Proof.
      unfold crosses_outside. destruct (existsb (at_edge pierces f) edge_list) eqn:Q; [intros _; now apply piercing_sound|cbn [orb]].
      rewrite !andb_true_iff, forallb_forall. intros [[Sa Sb] T]. apply all_six. intros i Hi.
      pose proof through_refuted as R. rewrite forallb_forall in R. specialize (R i (in_six i Hi)).
      destruct (refuted_sound _ _ R f) as (p & I & Hp). rewrite !in_app_iff in I. destruct I as [I|[I|[I|[I|[I|I]]]]]; [destruct (no_chirotope p I Hp)| | | | |eauto]; exfalso.
      - rewrite (pierce_pattern p I Hp) in Q. discriminate.
      - rewrite (one_sided_not _ _ I Hp) in Sa. discriminate.
      - rewrite (one_sided_not _ _ I Hp) in Sb. discriminate.
      - apply in_flat_map in I as (k & Ik & I). specialize (T k Ik). rewrite (no_way_not _ _ I Hp) in T. discriminate.
    Qed.

    Lemma straddle_pattern vs p : In p (straddle_patterns vs) -> holds f p = true -> straddles f vs = true.
    Proof.
      unfold straddle_patterns, straddles. intros I H. apply in_flat_map in I as (v & Iv & I). apply in_map_iff in I as (w & <- & Iw). apply filter_In in Iw as [Iw _].
      cbn in H. rewrite andb_true_r, andb_true_iff in H. destruct H as [A B]. rewrite andb_true_iff, !existsb_exists.
      split; [exists v; split; [exact Iv|]; destruct (f v)|exists w; split; [exact Iw|]; destruct (f w)]; cbn in *; congruence.
    Qed.
    Lemma pass_pattern t p : In p (pass_patterns t) -> holds f p = true -> passes_at f t = true.
    Proof.
      destruct t as [[a b] s]. cbn. intros I H. repeat destruct I as [<-|I]; try destruct I; cbn in H; destruct (f a), (f b), (f s); cbn in *; congruence.
    Qed.

    Lemma outside_complete : cross_ origin v1 v2 w0 w1 w2 -> forallb (fun v => seq (f v) O) [1; 2; 3; 4; 5; 6]%positive = false -> crosses_outside f = true.
    Proof.
      intros (x & [B S] & A) NZ. unfold crosses_outside. destruct (existsb (at_edge pierces f) edge_list) eqn:Q; [reflexivity|cbn [orb]].
      assert (M : meets_at origin v1 v2 w0 w1 w2 (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat) (x 4%nat) (x 5%nat)).
      { split; [exact B|]. split; [exact S|]. split.
        - repeat apply Forall_cons; try apply Forall_nil; rewrite A by lia; discriminate.
        - apply sg_add; [rewrite sg_add; rewrite ?A by lia; discriminate || reflexivity|apply A; lia]. }
      set (all := l ++ [x 0%nat; x 1%nat; x 2%nat; x 3%nat; x 4%nat; x 5%nat]).
      assert (Low : forall v, In v determinants -> sign_of all v = f v).
      { intros v Iv. unfold f, sign_of, all. f_equal. apply pick_app. unfold l, fifteen. cbn in Iv. repeat destruct Iv as [<-|Iv]; try destruct Iv; cbn; lia. }
      pose (low := fun p : pattern => forallb (fun t => existsb (Pos.eqb (fst t)) determinants) p).
      assert (Down : forall p, low p = true -> holds (sign_of all) p = holds f p).
      { unfold low, holds. induction p as [|t p IH]; cbn [forallb]; auto. rewrite andb_true_iff. intros [A1 A2]. apply existsb_exists in A1 as (v & Iv & A1).
        apply Pos.eqb_eq in A1. subst v. now rewrite IH, Low. }
      assert (Lows : forallb low (all_pierce ++ concat demands) = true) by (vm_compute; reflexivity).
      rewrite forallb_forall in Lows.
      assert (G : forall d, In d demands -> exists p, In p d /\ holds (sign_of all) p = true).
      { intros d Id. pose proof crossing_refuted as R. rewrite forallb_forall in R. specialize (R d Id).
        destruct (refuted_sound _ _ R (sign_of all)) as (p & I & Hp). unfold positive_facts in I. rewrite !in_app_iff in I.
        destruct I as [[I|[I|[I|I]]]|[I|I]]; [exfalso|exfalso|exfalso|exfalso|exfalso|eauto].
        - exact (zero_sums (pick all) _ _ (cramer_holds _ _ _ _ _ _ _ _ _ _ _ M) I Hp).
        - exact (no_five _ p I Hp).
        - apply in_map_iff in I as (v & <- & Iv). unfold holds in Hp. cbn [forallb fst snd] in Hp. rewrite andb_true_r in Hp.
          assert (K : sign_of all v = P) by (cbn in Iv; repeat destruct Iv as [<-|Iv]; try destruct Iv; unfold sign_of, all, l, fifteen; cbn; apply A; lia).
          rewrite K in Hp. discriminate.
        - apply all_zero_holds with (f := sign_of all) in I; auto. enough (true = false) by discriminate. rewrite <- NZ. symmetry. apply forallb_forall.
          intros v Iv. apply seq_eq. rewrite <- Low by (clear - Iv; cbn in *; tauto). rewrite Forall_forall in I. now apply I.
        - enough (true = false) by discriminate. rewrite <- Q. symmetry. apply (pierce_pattern p I). rewrite <- Down; auto. apply Lows, in_app_iff. now left. }
      assert (H : forall d, In d demands -> exists p, In p d /\ holds f p = true).
      { intros d Id. destruct (G d Id) as (p & I & Hp). exists p. split; auto. rewrite <- Down; auto. apply Lows, in_app_iff. right. apply in_concat. eauto. }
      rewrite !andb_true_iff, forallb_forall. split; [split|].
      - destruct (H (straddle_patterns [1; 2; 3]%positive)) as (p & I & Hp); [now left|]. eapply straddle_pattern; eauto.
      - destruct (H (straddle_patterns [4; 5; 6]%positive)) as (p & I & Hp); [right; now left|]. eapply straddle_pattern; eauto.
      - intros k Ik. destruct (H (flat_map pass_patterns (through k))) as (p & I & Hp).
        { unfold demands. right. right. apply (in_map (fun k => flat_map pass_patterns (through k))), Ik. }
        apply in_flat_map in I as (t & It & I). apply existsb_exists. exists t. split; auto. eapply pass_pattern; eauto.
    Qed.
  End Outside.

  (** * Along one coordinate *)
  Definition nearly_below (a b : list C) : bool := forallb (fun x => forallb (fun y => negb (seq (sg (y - x)) N)) b) a.
  Definition level (a b : list C) : bool := forallb (fun x => forallb (fun y => seq (sg (y - x)) O) b) a.
  (** One range is not above the other, and not all ends are equal. *)
  Definition nearly_apart (a b : list C) : bool := (nearly_below a b || nearly_below b a) && negb (level a b).
  Definition straddle (a : list C) : bool := existsb (fun x => seq (sg x) P) a && existsb (fun x => seq (sg x) N) a.

  Lemma opp_sign a b : sg (a - b) = sopp (sg (b - a)).
  Proof. rewrite <- sg_opp. f_equal. ring. Qed.
  Lemma level_sym a0 a1 a2 b0 b1 b2 : level [b0; b1; b2] [a0; a1; a2] = level [a0; a1; a2] [b0; b1; b2].
  Proof.
    assert (T : forall a b, seq (sg (a - b)) O = seq (sg (b - a)) O) by (intros; rewrite opp_sign; now destruct (sg (b - a))).
    unfold level. cbn. rewrite (T a0 b0), (T a0 b1), (T a0 b2), (T a1 b0), (T a1 b1), (T a1 b2), (T a2 b0), (T a2 b1), (T a2 b2).
    destruct (seq (sg (b0 - a0)) O), (seq (sg (b1 - a0)) O), (seq (sg (b2 - a0)) O), (seq (sg (b0 - a1)) O), (seq (sg (b1 - a1)) O), (seq (sg (b2 - a1)) O),
      (seq (sg (b0 - a2)) O), (seq (sg (b1 - a2)) O), (seq (sg (b2 - a2)) O); reflexivity.
  Qed.
  (** Numbers that are not negative and have the sum 0. *)
  Lemma all_zero_sum xs : sum xs = 0 -> Forall (fun x => sg x <> N) xs -> Forall (fun x => sg x = O) xs.
  Proof.
    intros S G. apply Forall_forall. intros x I. assert (N' : sg x <> N) by (rewrite Forall_forall in G; auto).
    destruct (sg x) eqn:E; auto; [congruence|]. exfalso. destruct (sum_ge xs G) as [_ K]. rewrite S, sg0 in K.
    enough (O = P) by discriminate. apply K, Exists_exists. eauto.
  Qed.
  Lemma below_is_level a0 a1 a2 b0 b1 b2 x0 x1 x2 y0 y1 y2 : Forall (fun x => sg x = P) [x0; x1; x2; y0; y1; y2] -> x0 + x1 + x2 = y0 + y1 + y2 ->
    x0 * a0 + x1 * a1 + x2 * a2 = y0 * b0 + y1 * b1 + y2 * b2 -> nearly_below [a0; a1; a2] [b0; b1; b2] = true -> level [a0; a1; a2] [b0; b1; b2] = true.
  Proof.
    intros G S E H. repeat rewrite Forall_cons_iff in G. destruct G as (X0 & X1 & X2 & Y0 & Y1 & Y2 & _).
    assert (T : forall x y d, sg x = P -> sg y = P -> sg (x * (y * d)) = sg d) by (intros x y d A B; rewrite !sg_mul, A, B; now destruct (sg d)).
    assert (Z : Forall (fun x => sg x = O) [x0 * (y0 * (b0 - a0)); x0 * (y1 * (b1 - a0)); x0 * (y2 * (b2 - a0)); x1 * (y0 * (b0 - a1)); x1 * (y1 * (b1 - a1));
      x1 * (y2 * (b2 - a1)); x2 * (y0 * (b0 - a2)); x2 * (y1 * (b1 - a2)); x2 * (y2 * (b2 - a2))]).
    { apply all_zero_sum.
      - cbn. transitivity ((x0 + x1 + x2) * (y0 * b0 + y1 * b1 + y2 * b2) - (y0 + y1 + y2) * (x0 * a0 + x1 * a1 + x2 * a2)); [ring|]. rewrite <- E, <- S. ring.
      - unfold nearly_below in H. cbn in H. rewrite !andb_true_iff, !negb_true_iff in H.
        repeat apply Forall_cons; try apply Forall_nil; rewrite T by assumption; intros K; rewrite K in H; cbn in H; intuition discriminate. }
    repeat rewrite Forall_cons_iff in Z. rewrite !T in Z by assumption. unfold level. cbn.
    destruct Z as (-> & -> & -> & -> & -> & -> & -> & -> & -> & _). reflexivity.
  Qed.
  Lemma nearly_apart_sound a0 a1 a2 b0 b1 b2 x0 x1 x2 y0 y1 y2 : Forall (fun x => sg x = P) [x0; x1; x2; y0; y1; y2] -> x0 + x1 + x2 = y0 + y1 + y2 ->
    x0 * a0 + x1 * a1 + x2 * a2 = y0 * b0 + y1 * b1 + y2 * b2 -> nearly_apart [a0; a1; a2] [b0; b1; b2] = false.
  Proof.
    intros G S E. unfold nearly_apart. destruct (level [a0; a1; a2] [b0; b1; b2]) eqn:K; [apply andb_false_r|]. rewrite andb_true_r, orb_false_iff. split.
    - destruct (nearly_below [a0; a1; a2] _) eqn:H; auto. rewrite <- K. symmetry. eapply below_is_level; eauto.
    - destruct (nearly_below [b0; b1; b2] _) eqn:H; auto. rewrite <- K, <- level_sym. symmetry.
      apply (below_is_level _ _ _ _ _ _ y0 y1 y2 x0 x1 x2); auto. repeat rewrite Forall_cons_iff in *. tauto.
  Qed.
  Definition row (x : nat -> C) (a0 a1 a2 b0 b1 b2 : C) : Prop :=
    x 0%nat * a0 + x 1%nat * a1 + x 2%nat * a2 = x 3%nat * b0 + x 4%nat * b1 + x 5%nat * b2 /\ x 0%nat + x 1%nat + x 2%nat = x 3%nat + x 4%nat + x 5%nat.
  Lemma pulled a b d t a0 a1 a2 b0 b1 b2 : In a [a0; a1; a2] -> In b [b0; b1; b2] -> sg d = P -> sg t <> N ->
    d * (a0 + a1 + a2 - (b0 + b1 + b2)) + t * (a - b) = 0 -> exists x, row x a0 a1 a2 b0 b1 b2 /\ all_positive x.
  Proof.
    intros Ia Ib Hd Ht Z. destruct (unit_weights _ _ _ _ Ia) as (r0 & r1 & r2 & Gr & Sr & Er). destruct (unit_weights _ _ _ _ Ib) as (s0 & s1 & s2 & Gs & Ss & Es).
    exists (fun i => nth i [d + t * r0; d + t * r1; d + t * r2; d + t * s0; d + t * s1; d + t * s2] 0). unfold row. cbn. split; [split|].
    - transitivity (d * (a0 + a1 + a2) + t * (r0 * a0 + r1 * a1 + r2 * a2)); [ring|]. transitivity (d * (b0 + b1 + b2) + t * (s0 * b0 + s1 * b1 + s2 * b2)); [|ring].
      rewrite Er, Es. transitivity (d * (a0 + a1 + a2 - (b0 + b1 + b2)) + t * (a - b) + (d * (b0 + b1 + b2) + t * b)); [ring|]. rewrite Z. ring.
    - transitivity (d * (1 + 1 + 1) + t * (r0 + r1 + r2)); [ring|]. transitivity (d * (1 + 1 + 1) + t * (s0 + s1 + s2)); [|ring]. now rewrite Sr, Ss.
    - repeat rewrite Forall_cons_iff in *. assert (T : forall r, sg r <> N -> sg (d + t * r) = P).
      { intros r Hr. replace (d + t * r) with (t * r + d) by ring. apply sg_add; auto. now apply ge_mul. }
      intros i Hi. do 6 (destruct i as [|i]; [cbn; apply T; tauto|]). lia.
  Qed.
  Lemma not_nearly_below a b : nearly_below a b = false -> exists x y, In x a /\ In y b /\ sg (x - y) = P.
  Proof.
    unfold nearly_below. intros H. apply forallb_false in H as (x & I & H). apply forallb_false in H as (y & J & H).
    exists x, y. repeat split; auto. rewrite opp_sign. destruct (sg (y - x)); cbn in *; congruence.
  Qed.
  Lemma line_inside a0 a1 a2 b0 b1 b2 : nearly_apart [a0; a1; a2] [b0; b1; b2] = false -> exists x, row x a0 a1 a2 b0 b1 b2 /\ all_positive x.
  Proof.
    intros H. set (s := a0 + a1 + a2 - (b0 + b1 + b2)). assert (one_P : sg 1 = P) by apply sg_one. destruct (sg s) eqn:Es.
    2: { apply sg_zero in Es. apply (pulled a0 b0 1 0); cbn; auto; [rewrite sg0; discriminate|]. fold s. rewrite Es. ring. }
    all: unfold nearly_apart in H; apply andb_false_iff in H as [H|H].
    2, 4: exfalso; apply negb_false_iff in H; unfold level in H; cbn in H; rewrite !andb_true_iff, !seq_eq, !sg_zero in H;
      destruct H as ((H0 & _) & (_ & H1 & _) & (_ & _ & H2 & _) & _); enough (K : s = 0) by (rewrite K, sg0 in Es; discriminate);
      transitivity (- ((b0 - a0) + (b1 - a1) + (b2 - a2))); [unfold s; ring|rewrite H0, H1, H2; ring].
    all: apply orb_false_iff in H as [H K]; apply not_nearly_below in H as (a & b & Ia & Ib & H); apply not_nearly_below in K as (b' & a' & Ib' & Ia' & K).
    - apply (pulled a b (a - b) (- s)); auto; [rewrite sg_opp, Es; discriminate|]. fold s. ring.
    - apply (pulled a' b' (b' - a') s); auto; [congruence|]. fold s. ring.
  Qed.

  (** * In one plane *)
  Section Rule.
    Variables v1 v2 w0 w1 w2 : vec.
    Definition boxes_nearly_apart : bool := existsb (fun c : vec -> C => nearly_apart [0; c v1; c v2] [c w0; c w1; c w2]) [X; Y; Z].
    Definition nearly_parted (p : vec -> L.point) : bool :=
      existsb (nearly_parts_edge (L.plane_sign (p origin) (p v1) (p v2) (p w0) (p w1) (p w2))) plane_edges.
    Definition inside : bool :=
      if some_moment v1 v2 w0 w1 w2 X then negb (nearly_parted along_x || boxes_nearly_apart) else
      if some_moment v1 v2 w0 w1 w2 Y then negb (nearly_parted along_y || boxes_nearly_apart) else
      if some_moment v1 v2 w0 w1 w2 Z then negb (nearly_parted along_z || boxes_nearly_apart) else
      if zero_vec (cross (first_of [v1; v2]) (first_of [w0; w1; w2])) then negb boxes_nearly_apart
      else existsb (fun c : vec -> C => seq (smul (sg (c v1)) (sg (c v2))) N) [X; Y; Z] && existsb (fun c : vec -> C => straddle [c w0; c w1; c w2]) [X; Y; Z].
    (** Whether the pair crosses, as docs/exact.md has it. *)
    Definition crosses : bool :=
      let f := sign_of (fifteen v1 v2 w0 w1 w2) in
      if forallb (fun v => seq (f v) O) [1; 2; 3; 4; 5; 6]%positive
      then forallb (fun v => seq (f v) O) [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive && negb (separate v1 v2 w0 w1 w2) && inside
      else crosses_outside f.
  End Rule.
  Definition exact_crosses (p0 p1 p2 q0 q1 q2 : vec) : bool := crosses (minus p1 p0) (minus p2 p0) (minus q0 p0) (minus q1 p0) (minus q2 p0).

  Lemma cross_meets v1 v2 w0 w1 w2 x : balance origin v1 v2 w0 w1 w2 x -> all_positive x ->
    meets_at origin v1 v2 w0 w1 w2 (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat) (x 4%nat) (x 5%nat).
  Proof.
    intros [B S] A. split; [exact B|]. split; [exact S|]. split.
    - repeat apply Forall_cons; try apply Forall_nil; rewrite A by lia; discriminate.
    - apply sg_add; [rewrite sg_add; rewrite ?A by lia; discriminate || reflexivity|apply A; lia].
  Qed.
  Lemma six_positive x : all_positive x -> Forall (fun y => sg y = P) [x 0%nat; x 1%nat; x 2%nat; x 3%nat; x 4%nat; x 5%nat].
  Proof. intros A. repeat apply Forall_cons; try apply Forall_nil; apply A; lia. Qed.
  Lemma boxes_cross v1 v2 w0 w1 w2 : cross_ origin v1 v2 w0 w1 w2 -> boxes_nearly_apart v1 v2 w0 w1 w2 = false.
  Proof.
    intros (x & B & A). pose proof (coordinate _ _ _ _ _ _ _ _ _ _ _ (cross_meets _ _ _ _ _ _ B A)) as E. destruct B as [_ S].
    unfold boxes_nearly_apart. induction E as [|c cs E Es IH]; cbn -[nearly_apart]; auto. rewrite IH, orb_false_r.
    eapply nearly_apart_sound; eauto using six_positive.
  Qed.

  Section Six.
    Variables p0 p1 p2 p3 p4 p5 : L.point.
    Definition balance2 (x : nat -> C) : Prop := row x (fst p0) (fst p1) (fst p2) (fst p3) (fst p4) (fst p5) /\ row x (snd p0) (snd p1) (snd p2) (snd p3) (snd p4) (snd p5).
    Lemma balance2_add x y : balance2 x -> balance2 y -> balance2 (fun i => x i + y i).
    Proof.
      unfold balance2, row. intros [[A B] [K _]] [[A' B'] [K' _]].
      repeat split; [apply (added _ _ _ _ _ _ A A')|apply (added _ _ _ _ _ _ B B')|apply (added _ _ _ _ _ _ K K')|apply (added _ _ _ _ _ _ B B')]; ring.
    Qed.
    Let f := L.plane_sign p0 p1 p2 p3 p4 p5.
    Lemma circuit_balance2 q m : In q quads -> balance2 (weight (L.get (L.twenty p0 p1 p2 p3 p4 p5)) m (circuit q)).
    Proof.
      unfold quads. intros H. unfold balance2, row, weight, L.twenty. cbn [In] in H.
      repeat destruct H as [<-|H]; try destruct H; destruct m; cbn -[L.orient]; unfold L.orient; repeat split; ring.
    Qed.
    Lemma plane_inside : ~ Forall (fun v => f v = O) plane_moments -> existsb (nearly_parts_edge f) plane_edges = false -> exists x, balance2 x /\ all_positive x.
    Proof.
      intros NZ NP. apply gather; [apply balance2_add|]. intros i Hi. pose proof plane_inside_refuted as R. rewrite forallb_forall in R. specialize (R i (in_six i Hi)).
      destruct (refuted_sound _ _ R f) as (p & I & H). unfold plane_facts in I. rewrite !in_app_iff in I. destruct I as [[I|[I|I]]|[I|I]].
      - exfalso. exact (zero_sums (L.get (L.twenty p0 p1 p2 p3 p4 p5)) _ _ (L.gp_holds _ _ _ _ _ _) I H).
      - exfalso. apply in_flat_map in I as (q & Iq & I). apply in_app_iff in I as [I|I]; eapply L.no_affine; eauto.
      - exfalso. apply NZ. eapply all_zero_holds; eauto.
      - exfalso. apply in_flat_map in I as (e & Ie & I). enough (true = false) by discriminate. rewrite <- NP. symmetry. apply existsb_exists. exists e. split; auto.
        assert (N1 : forall t, signed_sign f true t = sopp (signed_sign f false t)) by (intros [[] u]; cbn; destruct (f u); reflexivity).
        assert (N2 : forall m c u, signed_sign f m (negb c, u) = sopp (signed_sign f m (c, u))) by (intros [] [] u; cbn; destruct (f u); reflexivity).
        destruct e as [[[t0 t1] t2] [b v]]. unfold nearly_patterns in I. apply in_app_iff in I as [I|I]; destruct (some_strict_holds _ _ _ _ I H) as [G K];
        repeat rewrite Forall_cons_iff in G; repeat rewrite Exists_cons in K; rewrite Exists_nil in K; rewrite ?N2, ?N1 in G; rewrite ?N2, ?N1 in K;
        unfold nearly_parts_edge; cbv zeta beta iota; revert G K;
        generalize (signed_sign f false t0) (signed_sign f false t1) (signed_sign f false t2) (signed_sign f false (b, v)); clear;
        intros [] [] [] [] G K; cbn in *; (reflexivity || (exfalso; intuition congruence)).
      - apply (positive_at_weights (L.get (L.twenty p0 p1 p2 p3 p4 p5)) _ _ _ _ I H). intros c m Ic. apply in_map_iff in Ic as (q & <- & Iq). now apply circuit_balance2.
    Qed.

    Lemma no_nearly t a x y z b c d : sg t = P -> sg x = P -> sg y = P -> sg z = P -> t * a = x * b + y * c + z * d -> nearly_parts (sg b) (sg c) (sg d) (sg a) = false.
    Proof.
      intros T X Y Z E. destruct (nearly_parts _ _ _ _) eqn:H; auto. exfalso.
      assert (M : forall u k, sg u = P -> sg (u * k) = sg k) by (intros u k U; rewrite sg_mul, U; now destruct (sg k)).
      assert (M' : forall u k, sg u = P -> sg (- (u * k)) = sopp (sg k)) by (intros; rewrite sg_opp, M; auto).
      assert (K : (Forall (fun x => sg x <> N) [t * a; - (x * b); - (y * c); - (z * d)] \/ Forall (fun x => sg x <> N) [- (t * a); x * b; y * c; z * d])
        /\ ~ (sg a = O /\ sg b = O /\ sg c = O /\ sg d = O)).
      { repeat rewrite Forall_cons_iff. rewrite !M, !M' by assumption. clear - H. unfold nearly_parts in H.
        destruct (sg a), (sg b), (sg c), (sg d); cbn in H; try discriminate; (split; [|intuition discriminate]); first [left; repeat split; (discriminate || constructor)|right; repeat split; (discriminate || constructor)]. }
      destruct K as [[K|K] N']; apply N'; apply all_zero_sum in K; try (cbn; rewrite E; ring); repeat rewrite Forall_cons_iff in K; rewrite ?M, ?M' in K by assumption;
      destruct (sg a), (sg b), (sg c), (sg d); cbn in K; intuition congruence.
    Qed.
    Ltac by_edge M p q :=
      first [refine (L.equal_by _ _ _ (L.functional2 _ _ _ _ _ _ _ _ _ _ _ _ (snd p - snd q) (fst q - fst p) (snd q * fst p - fst q * snd p) M) _); cbn; ring
      | refine (L.equal_by _ _ _ (L.functional2 _ _ _ _ _ _ _ _ _ _ _ _ (- (snd p - snd q)) (- (fst q - fst p)) (- (snd q * fst p - fst q * snd p)) M) _); cbn; ring].
    Lemma nearly_parts_apart x0 x1 x2 x3 x4 x5 : L.meets2 p0 p1 p2 p3 p4 p5 x0 x1 x2 x3 x4 x5 -> Forall (fun y => sg y = P) [x0; x1; x2; x3; x4; x5] ->
      existsb (nearly_parts_edge f) plane_edges = false.
    Proof.
      intros M G. repeat rewrite Forall_cons_iff in G. destruct G as (G0 & G1 & G2 & G3 & G4 & G5 & _).
      destruct (existsb _ _) eqn:H; auto. exfalso. apply existsb_exists in H as (e & I & H).
      let t := eval vm_compute in plane_edges in change plane_edges with t in I.
      unfold nearly_parts_edge in H. cbn [In] in I.
      repeat destruct I as [<-|I]; try destruct I; unfold f in H; rewrite <- !(L.signed_value_sign _ _ _ _ _ _ false) in H; unfold L.signed_value, L.twenty in H;
        cbn in H; unfold L.orient in H;
      (enough (false = true) by discriminate; rewrite <- H; symmetry);
      [refine (no_nearly x2 _ x3 x4 x5 _ _ _ G2 G3 G4 G5 _); by_edge M p0 p1
      |refine (no_nearly x0 _ x3 x4 x5 _ _ _ G0 G3 G4 G5 _); by_edge M p1 p2
      |refine (no_nearly x1 _ x3 x4 x5 _ _ _ G1 G3 G4 G5 _); by_edge M p2 p0
      |refine (no_nearly x5 _ x0 x1 x2 _ _ _ G5 G0 G1 G2 _); by_edge M p3 p4
      |refine (no_nearly x3 _ x0 x1 x2 _ _ _ G3 G0 G1 G2 _); by_edge M p4 p5
      |refine (no_nearly x4 _ x0 x1 x2 _ _ _ G4 G0 G1 G2 _); by_edge M p5 p3].
    Qed.
  End Six.

  Lemma plane_crosses along c v1 v2 w0 w1 w2 : In (along, c) [(along_x, X); (along_y, Y); (along_z, Z)] ->
    Forall (fun v => sign_of (fifteen v1 v2 w0 w1 w2) v = O) determinants -> some_moment v1 v2 w0 w1 w2 c = true ->
    negb (nearly_parted v1 v2 w0 w1 w2 along || boxes_nearly_apart v1 v2 w0 w1 w2) = true <-> cross_ origin v1 v2 w0 w1 w2.
  Proof.
    intros J A M. rewrite negb_true_iff. split.
    - rewrite orb_false_iff. intros [H _]. destruct (plane_inside _ _ _ _ _ _ (seen _ _ _ _ _ _ _ J M) H) as (x & [[B1 S] [B2 _]] & K).
      exists x. split; auto. apply some_moment_in in M as (m & I & NZ).
      destruct (lift along c v1 v2 w0 w1 w2 m (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat) (x 4%nat) (x 5%nat) J (normal_kills _ _ _ _ _ _ A I) NZ) as (E & _ & _); [|split; auto].
      assert (Q : meets_at origin origin origin origin origin origin (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat) (x 4%nat) (x 5%nat)).
      { apply cross_meets; auto. split; auto. unfold combine, origin. cbn. f_equal; ring. }
      destruct Q as (_ & _ & Q). split; [exact B1|]. split; [exact B2|]. split; [exact S|exact Q].
    - intros H. rewrite (boxes_cross _ _ _ _ _ H), orb_false_r. destruct H as (x & B & K).
      eapply nearly_parts_apart; [eapply projected; eauto; eapply cross_meets; eauto|now apply six_positive].
  Qed.

  (** * On one line, or on two lines through V0 *)
  Lemma line_cross g k v1 v2 w0 w1 w2 x : In k [X; Y; Z] -> k g <> 0 -> Forall (parallel g) [v1; v2; w0; w1; w2] ->
    row x 0 (k v1) (k v2) (k w0) (k w1) (k w2) -> all_positive x -> cross_ origin v1 v2 w0 w1 w2.
  Proof.
    intros Ik K A [E S] Q. assert (M : meets_at origin origin origin origin origin origin (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat) (x 4%nat) (x 5%nat)).
    { apply cross_meets; auto. split; auto. unfold combine, origin. cbn. f_equal; ring. }
    destruct M as (_ & _ & G & T). destruct (line_lift g k v1 v2 w0 w1 w2 _ _ _ _ _ _ Ik K A G T S E) as (B & _). exists x. repeat split; auto.
  Qed.
  Lemma nearly_coordinate k v1 v2 w0 w1 w2 : In k [X; Y; Z] -> boxes_nearly_apart v1 v2 w0 w1 w2 = false -> nearly_apart [0; k v1; k v2] [k w0; k w1; k w2] = false.
  Proof. unfold boxes_nearly_apart. cbn -[nearly_apart]. rewrite !orb_false_iff. intros [<-|[<-|[<-|[]]]]; tauto. Qed.
  Lemma straddle_inside a b c : straddle [a; b; c] = true -> exists x, row x 0 0 0 a b c /\ all_positive x.
  Proof.
    intros H. apply line_inside. unfold straddle in H. apply andb_true_iff in H as [H K]. apply existsb_exists in H as (p & Ip & H). apply existsb_exists in K as (n & In_ & K).
    apply seq_eq in H, K. unfold nearly_apart. apply andb_false_iff. left. apply orb_false_iff.
    assert (T : forall xs (g : C -> bool) x, In x xs -> g x = false -> forallb g xs = false).
    { intros xs g x I G. destruct (forallb g xs) eqn:E; auto. rewrite forallb_forall in E. rewrite E in G; auto. }
    split; unfold nearly_below.
    - apply (T _ _ 0); [now left|]. cbv beta. apply (T _ _ n In_). cbv beta. replace (n - 0) with n by ring. now rewrite K.
    - apply (T _ _ p Ip). cbv beta. apply (T _ _ 0); [now left|]. cbv beta. replace (0 - p) with (- p) by ring. now rewrite sg_opp, H.
  Qed.
  Lemma inside_straddles x a b c : sg (x 3%nat) = P -> sg (x 4%nat) = P -> sg (x 5%nat) = P -> x 3%nat * a + x 4%nat * b + x 5%nat * c = 0 ->
    sg a <> O \/ sg b <> O \/ sg c <> O -> straddle [a; b; c] = true.
  Proof.
    intros A B K E N'. pose proof (sum3 _ _ _ E) as Q. rewrite !sg_mul, A, B, K in Q. unfold straddle. cbn.
    destruct (sg a), (sg b), (sg c); cbn in *; intuition congruence.
  Qed.

  Lemma lines_cross v1 v2 w0 w1 w2 : parallel v1 v2 -> parallel w0 w1 -> parallel w1 w2 -> parallel w2 w0 ->
    (if zero_vec (cross (first_of [v1; v2]) (first_of [w0; w1; w2])) then negb (boxes_nearly_apart v1 v2 w0 w1 w2)
     else existsb (fun c : vec -> C => seq (smul (sg (c v1)) (sg (c v2))) N) [X; Y; Z] && existsb (fun c : vec -> C => straddle [c w0; c w1; c w2]) [X; Y; Z]) = true
    <-> cross_ origin v1 v2 w0 w1 w2.
  Proof.
    intros Pv P0 P1 P2. pose proof (pairwise _ _ _ P0 P1 P2) as PW.
    set (v := first_of [v1; v2]). set (w := first_of [w0; w1; w2]).
    assert (NC : forall g, g <> origin -> exists c, In c [X; Y; Z] /\ c g <> 0).
    { intros g NZ. apply nonzero_coordinate. destruct (zero_vec g) eqn:E; auto. apply zero_vec_eq in E. tauto. }
    destruct (zero_vec (cross v w)) eqn:U.
    - rewrite negb_true_iff. split; [|apply boxes_cross]. intros H. apply zero_vec_eq in U. change (parallel v w) in U.
      assert (T : forall g, g <> origin -> Forall (parallel g) [v1; v2; w0; w1; w2] -> cross_ origin v1 v2 w0 w1 w2).
      { intros g NZ A. destruct (NC g NZ) as (k & Ik & K). destruct (line_inside _ _ _ _ _ _ (nearly_coordinate k _ _ _ _ _ Ik H)) as (x & R & Q). eapply line_cross; eauto. }
      destruct (first_of_spec [w0; w1; w2]) as [[Ew Aw]|[Iw Nw]]; destruct (first_of_spec [v1; v2]) as [[Ev Av]|[Iv Nv]];
        try fold v in Ev; try fold v in Iv; try fold v in Nv; try fold w in Ew; try fold w in Iw; try fold w in Nw.
      + repeat rewrite Forall_cons_iff in *. destruct Aw as (-> & -> & -> & _). destruct Av as (-> & -> & _).
        exists (fun _ => 1). split; [split; unfold combine, origin; cbn; try f_equal; ring|]. intros i _. apply sg_one.
      + apply (T v Nv). repeat rewrite Forall_cons_iff in Aw. destruct Aw as (-> & -> & -> & _).
        assert (V : parallel v v1 /\ parallel v v2) by (cbn [In] in Iv; destruct Iv as [<-|[<-|[]]]; auto using parallel_self, parallel_sym).
        repeat apply Forall_cons; try apply Forall_nil; try apply parallel_origin; tauto.
      + apply (T w Nw). repeat rewrite Forall_cons_iff in Av. destruct Av as (-> & -> & _).
        repeat apply Forall_cons; try apply Forall_nil; try apply parallel_origin; (apply PW; [exact Iw|cbn; auto]).
      + apply (T w Nw).
        assert (V : parallel v v1 /\ parallel v v2) by (cbn [In] in Iv; destruct Iv as [<-|[<-|[]]]; auto using parallel_self, parallel_sym).
        repeat apply Forall_cons; try apply Forall_nil; try (apply (parallel_trans v); tauto); (apply PW; [exact Iw|cbn; auto]).
    - assert (Nv : v <> origin). { intros E. rewrite E in U. assert (K : zero_vec (cross origin w) = true) by (apply zero_vec_eq, parallel_sym, parallel_origin). congruence. }
      assert (Nw : w <> origin). { intros E. rewrite E in U. assert (K : zero_vec (cross v origin) = true) by apply zero_vec_eq, parallel_origin. congruence. }
      destruct (first_of_spec [w0; w1; w2]) as [[Ew _]|[Iw _]]; [exfalso; exact (Nw Ew)|]. fold w in Iw.
      destruct (first_of_spec [v1; v2]) as [[Ev _]|[Iv _]]; [exfalso; exact (Nv Ev)|]. fold v in Iv.
      assert (V : parallel v v1 /\ parallel v v2) by (cbn [In] in Iv; destruct Iv as [<-|[<-|[]]]; auto using parallel_self, parallel_sym).
      assert (W : parallel w w0 /\ parallel w w1 /\ parallel w w2) by (repeat split; apply PW; cbn; auto).
      rewrite andb_true_iff. split.
      + intros [H K]. apply existsb_exists in H as (c & Ic & H). apply existsb_exists in K as (d & Id & K). apply seq_eq in H.
        destruct (straddle_inside _ _ _ K) as (y & [Ey Sy] & Qy).
        (* A: |c v2| v1 + |c v1| v2 is the origin. *)
        assert (Ha : exists a b, sg a = P /\ sg b = P /\ forall e, In e [X; Y; Z] -> a * e v1 + b * e v2 = 0).
        { pose proof (parallel_coordinates _ _ Pv) as PP. destruct (sg (c v1)) eqn:S1; try discriminate.
          - exists (c v2), (- c v1). assert (S2 : sg (c v2) = P) by (destruct (sg (c v2)); cbn in H; congruence). rewrite sg_opp, S1. repeat split; auto.
            intros e Ie. transitivity (e v1 * c v2 - c v1 * e v2); [ring|]. rewrite (PP e c Ie Ic). ring.
          - exists (- c v2), (c v1). assert (S2 : sg (c v2) = N) by (destruct (sg (c v2)); cbn in H; congruence). rewrite sg_opp, S2. repeat split; auto.
            intros e Ie. transitivity (- (e v1 * c v2 - c v1 * e v2)); [ring|]. rewrite (PP e c Ie Ic). ring. }
        destruct Ha as (a & b & Pa & Pb & Hab). set (t := y 0%nat + y 1%nat + y 2%nat). assert (Pt : sg t = P).
        { unfold t. apply sg_add; [rewrite sg_add; rewrite ?Qy by lia; discriminate || reflexivity|apply Qy; lia]. }
        assert (Hy : forall e, In e [X; Y; Z] -> y 3%nat * e w0 + y 4%nat * e w1 + y 5%nat * e w2 = 0).
        { assert (Nd : sg (d w0) <> O \/ sg (d w1) <> O \/ sg (d w2) <> O) by (unfold straddle in K; cbn in K; destruct (sg (d w0)), (sg (d w1)), (sg (d w2)); cbn in K; intuition congruence).
          assert (Dw : d w <> 0).
          { intros Z0. assert (A : forall u, parallel w u -> d u = 0).
            { intros u Pu. destruct (NC w Nw) as (k & Ik & Nk). destruct (cancel (k w) (d u)) as [F|F]; [|tauto|exact F]. rewrite (parallel_coordinates _ _ Pu k d Ik Id), Z0. ring. }
            rewrite !A in Nd by tauto. rewrite sg0 in Nd. intuition congruence. }
          intros e Ie. destruct (cancel (d w) (y 3%nat * e w0 + y 4%nat * e w1 + y 5%nat * e w2)) as [F|F]; [|tauto|exact F].
          transitivity (y 3%nat * (d w * e w0) + y 4%nat * (d w * e w1) + y 5%nat * (d w * e w2)); [ring|].
          destruct W as (W0 & W1 & W2). rewrite (parallel_coordinates _ _ W0 d e Id Ie), (parallel_coordinates _ _ W1 d e Id Ie), (parallel_coordinates _ _ W2 d e Id Ie).
          transitivity (e w * (y 3%nat * d w0 + y 4%nat * d w1 + y 5%nat * d w2)); [ring|]. rewrite <- Ey. ring. }
        (* The weights of A: t, t a, t b; of B: (1 + a + b) y. *)
        assert (Pn : sg (1 + a + b) = P) by (apply sg_add; auto; rewrite sg_add; auto; [discriminate|rewrite sg_one; discriminate]).
        exists (fun i => nth i [t; t * a; t * b; (1 + a + b) * y 3%nat; (1 + a + b) * y 4%nat; (1 + a + b) * y 5%nat] 0). split; [split; cbn|].
        * unfold combine, origin. cbn. f_equal; match goal with |- ?l = _ => match l with context [?e v1] => 
            transitivity (t * (a * e v1 + b * e v2)); [ring|]; rewrite (Hab e) by (cbn; auto); transitivity ((1 + a + b) * (y 3%nat * e w0 + y 4%nat * e w1 + y 5%nat * e w2)); [rewrite (Hy e) by (cbn; auto); ring|ring] end end.
        * transitivity ((1 + a + b) * t); [ring|]. unfold t. rewrite Sy. ring.
        * intros i Hi. do 6 (destruct i as [|i]; [cbn; rewrite ?sg_mul, ?Pt, ?Pa, ?Pb, ?Pn, ?Qy by lia; reflexivity|]). lia.
      + intros (x & [B S] & Q). assert (Z0 : combine (x 0%nat) (x 1%nat) (x 2%nat) origin v1 v2 = origin).
        { destruct (zero_vec (combine (x 0%nat) (x 1%nat) (x 2%nat) origin v1 v2)) eqn:E; [now apply zero_vec_eq|exfalso].
          assert (NZ : combine (x 0%nat) (x 1%nat) (x 2%nat) origin v1 v2 <> origin) by (intros F; apply zero_vec_eq in F; congruence).
          enough (zero_vec (cross v w) = true) by congruence. apply zero_vec_eq. apply (parallel_trans _ _ _ NZ).
          - apply parallel_sym, parallel_combine; try tauto. apply parallel_origin.
          - apply parallel_sym. rewrite B. apply parallel_combine; tauto. }
        pose proof Z0 as Z1. rewrite B in Z1. unfold combine, origin in Z0, Z1. injection Z0 as A1 A2 A3. injection Z1 as B1 B2 B3. cbn in A1, A2, A3.
        assert (Q1 : sg (x 1%nat) = P) by (apply Q; lia). assert (Q2 : sg (x 2%nat) = P) by (apply Q; lia).
        split; apply existsb_exists.
        * destruct (NC v Nv) as (c & Ic & Nc). exists c. split; auto. apply seq_eq.
          assert (E : x 0%nat * 0 + x 1%nat * c v1 + x 2%nat * c v2 = 0) by (cbn in Ic; destruct Ic as [<-|[<-|[<-|[]]]]; auto).
          pose proof (sum3 _ _ _ E) as K. rewrite !sg_mul, Q1, Q2, sg0 in K. rewrite <- sg_zero in Nc.
          assert (N2 : sg (c v1) <> O \/ sg (c v2) <> O) by (cbn [In] in Iv; destruct Iv as [F|[F|[]]]; rewrite <- F in Nc; auto).
          clear - K N2. destruct (sg (x 0%nat)), (sg (c v1)), (sg (c v2)); cbn in *; intuition congruence.
        * destruct (NC w Nw) as (c & Ic & Nc). exists c. split; auto. apply (inside_straddles x); try (apply Q; lia).
          -- cbn in Ic; destruct Ic as [<-|[<-|[<-|[]]]]; auto.
          -- rewrite <- sg_zero in Nc. cbn [In] in Iw. destruct Iw as [F|[F|[F|[]]]]; rewrite <- F in Nc; auto.
  Qed.

  (** * The theorem *)
  Theorem origin_crosses v1 v2 w0 w1 w2 : crosses v1 v2 w0 w1 w2 = true <-> cross_ origin v1 v2 w0 w1 w2.
  Proof.
    assert (ME : cross_ origin v1 v2 w0 w1 w2 -> separate v1 v2 w0 w1 w2 = false).
    { intros (x & B & Q). apply separate_right. do 6 eexists. eapply cross_meets; eauto. }
    unfold crosses. set (f := sign_of (fifteen v1 v2 w0 w1 w2)).
    assert (T : forall vs, forallb (fun v => seq (f v) O) vs = true <-> Forall (fun v => f v = O) vs).
    { intros vs. rewrite forallb_forall, Forall_forall. split; intros H v I; [apply seq_eq|apply seq_eq]; auto. }
    destruct (forallb _ [1; 2; 3; 4; 5; 6]%positive) eqn:F; [destruct (forallb _ [7; 8; 9; 10; 11; 12; 13; 14; 15]%positive) eqn:G|].
    - cbn [andb]. apply T in F, G.
      assert (A : Forall (fun v => f v = O) determinants) by exact (proj2 (Forall_app _ [1; 2; 3; 4; 5; 6]%positive _) (conj F G)).
      enough (In_ : inside v1 v2 w0 w1 w2 = true <-> cross_ origin v1 v2 w0 w1 w2).
      { rewrite andb_true_iff, In_, negb_true_iff. intuition. }
      unfold inside. destruct (some_moment _ _ _ _ _ X) eqn:MX; [apply (plane_crosses _ X); cbn; auto|].
      destruct (some_moment _ _ _ _ _ Y) eqn:MY; [apply (plane_crosses _ Y); cbn; auto|].
      destruct (some_moment _ _ _ _ _ Z) eqn:MZ; [apply (plane_crosses _ Z); cbn; auto|].
      pose proof (no_moment _ _ _ _ _ MX MY MZ) as N'. unfold moments in N'. repeat rewrite Forall_cons_iff in N'.
      destruct N' as (N0 & N1 & N2 & N3 & _). now apply lines_cross.
    - cbn [andb]. split; [discriminate|]. intros K. apply ME in K. unfold separate in K. fold f in K. rewrite F, G in K. discriminate.
    - split; [apply outside_sound|]. intros K. now apply outside_complete.
  Qed.

  Lemma cross_shift v0 v1 v2 w0 w1 w2 : cross_ v0 v1 v2 w0 w1 w2 <-> cross_ origin (minus v1 v0) (minus v2 v0) (minus w0 v0) (minus w1 v0) (minus w2 v0).
  Proof.
    unfold cross_, balance. split; intros (x & [E S] & Q); exists x; repeat split; auto; revert E S; generalize (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat) (x 4%nat) (x 5%nat);
    clear; intros x0 x1 x2 x3 x4 x5 E S; destruct v0, v1, v2, w0, w1, w2; unfold combine, minus, origin in *; cbn in *; injection E as E1 E2 E3;
    assert (S0 : x0 = x3 + x4 + x5 - x1 - x2) by (rewrite <- S; ring); clear S.
    - f_equal; [transitivity ((x0 * X0 + x1 * X1 + x2 * X2) - (x0 + x1 + x2) * X0)|
        transitivity ((x0 * Y0 + x1 * Y1 + x2 * Y2) - (x0 + x1 + x2) * Y0)|
        transitivity ((x0 * Z0 + x1 * Z1 + x2 * Z2) - (x0 + x1 + x2) * Z0)]; try ring; rewrite ?E1, ?E2, ?E3, S0; ring.
    - f_equal; [transitivity ((x0 * 0 + x1 * (X1 - X0) + x2 * (X2 - X0)) + (x0 + x1 + x2) * X0)|
        transitivity ((x0 * 0 + x1 * (Y1 - Y0) + x2 * (Y2 - Y0)) + (x0 + x1 + x2) * Y0)|
        transitivity ((x0 * 0 + x1 * (Z1 - Z0) + x2 * (Z2 - Z0)) + (x0 + x1 + x2) * Z0)]; try ring; rewrite ?E1, ?E2, ?E3, S0; ring.
  Qed.
  Theorem crosses_right p0 p1 p2 q0 q1 q2 : exact_crosses p0 p1 p2 q0 q1 q2 = true <-> cross_ p0 p1 p2 q0 q1 q2.
  Proof. unfold exact_crosses. rewrite origin_crosses. symmetry. apply cross_shift. Qed.
End Crosses.

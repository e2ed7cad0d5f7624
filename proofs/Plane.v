(** Six points in a plane, not all on one line through the first: an edge parts the two triangles, or they have a common point
    ([plane_complete]); if one parts them they have none ([parts_apart]). Section 7 of docs/exact.md, pairs in one plane. *)
From Coq Require Import List Bool PArith ZArith Ring.
Require Import Efsat.Sign Efsat.Domain Efsat.Table Efsat.PlaneTable.
Import ListNotations.

Module Plane (D : DOM).
  Module F := Facts D.
  Import D F.
  Local Open Scope dom.

  Definition get (l : list C) (v : positive) : C := nth (place v) l 0.
  Definition point := (C * C)%type.
  Definition orient (p q r : point) : C := (fst q - fst p) * (snd r - snd p) - (snd q - snd p) * (fst r - fst p).

  Definition meets2 (p0 p1 p2 p3 p4 p5 : point) (x0 x1 x2 x3 x4 x5 : C) : Prop :=
    x0 * fst p0 + x1 * fst p1 + x2 * fst p2 = x3 * fst p3 + x4 * fst p4 + x5 * fst p5 /\
    x0 * snd p0 + x1 * snd p1 + x2 * snd p2 = x3 * snd p3 + x4 * snd p4 + x5 * snd p5 /\
    x0 + x1 + x2 = x3 + x4 + x5 /\ Forall (fun x => sg x <> N) [x0; x1; x2; x3; x4; x5] /\ sg (x0 + x1 + x2) = P.

  (** Weights that are not all 0 have a positive sum on both sides. *)
  Lemma positive_sum x0 x1 x2 x3 x4 x5 : x0 + x1 + x2 = x3 + x4 + x5 -> Forall (fun x => sg x <> N) [x0; x1; x2; x3; x4; x5] ->
    Exists (fun x => sg x = P) [x0; x1; x2; x3; x4; x5] -> sg (x0 + x1 + x2) = P.
  Proof.
    intros S G E. repeat rewrite Forall_cons_iff in G. repeat rewrite Exists_cons in E. rewrite Exists_nil in E.
    assert (A : forall x y z, sg x <> N -> sg y <> N -> sg z <> N -> sg x = P \/ sg y = P \/ sg z = P -> sg (x + y + z) = P).
    { intros x y z X Y Z K. replace (x + y + z) with (sum [x; y; z]) by (cbn; ring).
      apply sum_ge; [repeat constructor; auto|]. repeat rewrite Exists_cons. tauto. }
    destruct E as [E|[E|[E|[E|[E|[E|[]]]]]]]; try (apply A; tauto); rewrite S; apply A; tauto.
  Qed.

  Section Six.
    Variables p0 p1 p2 p3 p4 p5 : point.
    Definition twenty : list C := Eval cbv [map triples nth] in
      map (fun t => let '(i, j, k) := t in let p n := nth n [p0; p1; p2; p3; p4; p5] p0 in orient (p i) (p j) (p k)) triples.
    Definition plane_sign v := sg (get twenty v).

    Lemma gp_holds : Forall (zero_sum (get twenty)) (map gp fives).
    Proof.
      let t := eval vm_compute in (map gp fives) in change (map gp fives) with t.
      unfold twenty. repeat apply Forall_cons; try apply Forall_nil; cbn; unfold orient; ring.
    Qed.

    Definition signed_value (m : bool) (t : signed) : C := let '(b, v) := t in if xorb b m then - get twenty v else get twenty v.
    Lemma signed_value_sign m t : sg (signed_value m t) = signed_sign plane_sign m t.
    Proof. destruct t as [b v]. cbn. destruct (xorb b m); auto. apply sg_opp. Qed.

    Lemma affine_holds m q : In q quads -> sum (map (signed_value m) (affine q)) = 0.
    Proof.
      unfold quads, twenty, signed_value. cbn [In]. intros H.
      repeat destruct H as [<-|H]; try destruct H; destruct m; cbn; unfold orient; ring.
    Qed.
    Lemma no_affine m q x : In q quads -> In x (some_strict m (affine q)) -> holds plane_sign x = true -> False.
    Proof.
      intros I J H. destruct (some_strict_holds _ _ _ _ J H) as [G E]. pose proof (affine_holds m q I) as S.
      destruct (sum_ge (map (signed_value m) (affine q))) as [_ K].
      - apply Forall_map. revert G. apply Forall_impl. intros t. now rewrite signed_value_sign.
      - rewrite S, sg0 in K. apply Exists_exists in E as (t & It & E). enough (O = P) by discriminate. apply K.
        apply Exists_exists. exists (signed_value m t). split; [now apply in_map|]. now rewrite signed_value_sign.
    Qed.

    Lemma circuit_common m q x : In q quads -> In x (some_strict m (somes (circuit q))) -> holds plane_sign x = true ->
      exists x0 x1 x2 x3 x4 x5, meets2 p0 p1 p2 p3 p4 p5 x0 x1 x2 x3 x4 x5.
    Proof.
      intros I J H. destruct (some_strict_holds _ _ _ _ J H) as [G E]. clear J H x.
      assert (G' : Forall (fun x => sg x <> N) (map (signed_value m) (somes (circuit q)))).
      { apply Forall_map. revert G. apply Forall_impl. intros t. now rewrite signed_value_sign. }
      assert (E' : Exists (fun x => sg x = P) (map (signed_value m) (somes (circuit q)))).
      { apply Exists_exists in E as (t & It & E). apply Exists_exists. exists (signed_value m t).
        split; [now apply in_map|now rewrite signed_value_sign]. }
      clear G E.
      pose (w := map (fun o => match o with Some t => signed_value m t | None => 0 end) (circuit q)).
      assert (Gw : Forall (fun x => sg x <> N) w).
      { unfold w. apply Forall_map. apply Forall_forall. intros [t|] It; [|rewrite sg0; discriminate].
        rewrite Forall_forall in G'. apply G'. apply in_map. unfold somes. apply in_flat_map. exists (Some t). cbn; auto. }
      assert (Ew : Exists (fun x => sg x = P) w).
      { apply Exists_exists in E' as (y & Iy & E'). apply in_map_iff in Iy as (t & <- & It). unfold somes in It.
        apply in_flat_map in It as (o & Iu & It). destruct o as [u|]; [destruct It as [<-|[]]|destruct It]. apply Exists_exists. exists (signed_value m u). split; auto.
        unfold w. apply in_map_iff. exists (Some u). auto. }
      assert (K : match w with [x0; x1; x2; x3; x4; x5] =>
          x0 * fst p0 + x1 * fst p1 + x2 * fst p2 = x3 * fst p3 + x4 * fst p4 + x5 * fst p5 /\
          x0 * snd p0 + x1 * snd p1 + x2 * snd p2 = x3 * snd p3 + x4 * snd p4 + x5 * snd p5 /\
          x0 + x1 + x2 = x3 + x4 + x5 | _ => False end).
      { unfold w, signed_value, twenty. revert I. clear. unfold quads. cbn [In]. intros H.
        repeat destruct H as [<-|H]; try destruct H; destruct m; cbn; unfold orient; repeat split; ring. }
      destruct w as [|x0 [|x1 [|x2 [|x3 [|x4 [|x5 [|]]]]]]]; try tauto.
      exists x0, x1, x2, x3, x4, x5. destruct K as (K1 & K2 & K3). repeat split; auto. now apply positive_sum with (3 := Ew).
    Qed.

    (** An edge that parts them: no common point. *)
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
    Lemma no_balance t a x y z b c d : sg t <> N -> sg x <> N -> sg y <> N -> sg z <> N -> sg (x + y + z) = P ->
      t * a = x * b + y * c + z * d -> parts (sg b) (sg c) (sg d) (sg a) = false.
    Proof.
      intros T X Y Z S E. destruct (parts (sg b) (sg c) (sg d) (sg a)) eqn:H; auto. exfalso.
      unfold parts in H. rewrite orb_true_iff, !andb_true_iff, !seq_eq in H.
      assert (U : sg (t * a) = smul (sg t) (sg a)) by apply sg_mul.
      destruct H as [[[[A B] K] L]|[[[A B] K] L]].
      - assert (V : sg (x * - b + y * - c + z * - d) = P) by (apply weighted; auto; rewrite sg_opp, ?A, ?B, ?K; reflexivity).
        assert (W : sg (t * a) = N). { rewrite E. replace (x * b + y * c + z * d) with (- (x * - b + y * - c + z * - d)) by ring. now rewrite sg_opp, V. }
        rewrite U in W. destruct (sg t), (sg a); cbn in *; congruence.
      - assert (W : sg (t * a) = P) by (rewrite E; apply weighted; auto).
        rewrite U in W. destruct (sg t), (sg a); cbn in *; congruence.
    Qed.
    Lemma functional2 x0 x1 x2 x3 x4 x5 a b c : meets2 p0 p1 p2 p3 p4 p5 x0 x1 x2 x3 x4 x5 ->
      let f p := a * fst p + b * snd p + c in
      x0 * f p0 + x1 * f p1 + x2 * f p2 - (x3 * f p3 + x4 * f p4 + x5 * f p5) = 0.
    Proof.
      intros (E1 & E2 & S & _). cbn.
      transitivity (a * ((x0 * fst p0 + x1 * fst p1 + x2 * fst p2) - (x3 * fst p3 + x4 * fst p4 + x5 * fst p5)) +
        b * ((x0 * snd p0 + x1 * snd p1 + x2 * snd p2) - (x3 * snd p3 + x4 * snd p4 + x5 * snd p5)) +
        c * ((x0 + x1 + x2) - (x3 + x4 + x5))); [ring|]. rewrite E1, E2, S. ring.
    Qed.
    Lemma equal_by x y z : z = 0 -> x - y = z -> x = y.
    Proof. intros -> H. transitivity (x - y + y); [ring|]. rewrite H. ring. Qed.
    Ltac by_edge M p q :=
      first [refine (equal_by _ _ _ (functional2 _ _ _ _ _ _ (snd p - snd q) (fst q - fst p) (snd q * fst p - fst q * snd p) M) _); cbn; ring
      | refine (equal_by _ _ _ (functional2 _ _ _ _ _ _ (- (snd p - snd q)) (- (fst q - fst p)) (- (snd q * fst p - fst q * snd p)) M) _); cbn; ring].
    Lemma parts_apart e : In e plane_edges -> parts_edge plane_sign e = true ->
      forall x0 x1 x2 x3 x4 x5, ~ meets2 p0 p1 p2 p3 p4 p5 x0 x1 x2 x3 x4 x5.
    Proof.
      intros I H x0 x1 x2 x3 x4 x5 M. assert (M' := M). destruct M' as (_ & _ & S & G & K).
      repeat rewrite Forall_cons_iff in G. destruct G as (G0 & G1 & G2 & G3 & G4 & G5 & _).
      let t := eval vm_compute in plane_edges in change plane_edges with t in I.
      unfold parts_edge in H. cbn [In] in I.
      repeat destruct I as [<-|I]; try destruct I; rewrite <- !(signed_value_sign false) in H; unfold signed_value, twenty in H;
        cbn in H; unfold orient in H;
      (enough (false = true) by discriminate; rewrite <- H; symmetry);
      [refine (no_balance x2 _ x3 x4 x5 _ _ _ G2 G3 G4 G5 (eq_trans (f_equal sg (eq_sym S)) K) _); by_edge M p0 p1
      |refine (no_balance x0 _ x3 x4 x5 _ _ _ G0 G3 G4 G5 (eq_trans (f_equal sg (eq_sym S)) K) _); by_edge M p1 p2
      |refine (no_balance x1 _ x3 x4 x5 _ _ _ G1 G3 G4 G5 (eq_trans (f_equal sg (eq_sym S)) K) _); by_edge M p2 p0
      |refine (no_balance x5 _ x0 x1 x2 _ _ _ G5 G0 G1 G2 K _); by_edge M p3 p4
      |refine (no_balance x3 _ x0 x1 x2 _ _ _ G3 G0 G1 G2 K _); by_edge M p4 p5
      |refine (no_balance x4 _ x0 x1 x2 _ _ _ G4 G0 G1 G2 K _); by_edge M p5 p3].
    Qed.

    Theorem plane_complete : ~ Forall (fun v => plane_sign v = O) plane_moments ->
      existsb (parts_edge plane_sign) plane_edges = false ->
      exists x0 x1 x2 x3 x4 x5, meets2 p0 p1 p2 p3 p4 p5 x0 x1 x2 x3 x4 x5.
    Proof.
      intros NZ NP. destruct (refuted_sound _ _ plane_refuted plane_sign) as (p & I & H).
      unfold plane_facts, circuit_patterns in I. rewrite !in_app_iff in I. destruct I as [[I|[I|I]]|[I|I]].
      - exfalso. exact (zero_sums (get twenty) _ _ gp_holds I H).
      - exfalso. apply in_flat_map in I as (q & Iq & I). apply in_app_iff in I as [I|I]; eapply no_affine; eauto.
      - exfalso. apply NZ. apply Forall_impl with (P := fun v => mem (plane_sign v) zer = true). 2: { destruct I as [<-|[]]. unfold holds in H. rewrite forallb_forall in H.
          apply Forall_forall. intros v J. exact (H (v, zer) (in_map (fun v => (v, zer)) _ _ J)). }
        intros v K. cbn in K. now destruct (plane_sign v).
      - apply in_flat_map in I as (q & Iq & I). apply in_app_iff in I as [I|I]; eapply circuit_common; eauto.
      - exfalso. apply in_flat_map in I as (e & Ie & I). enough (true = false) by discriminate. rewrite <- NP. symmetry.
        apply existsb_exists. exists e. split; auto. eapply part_patterns_part; eauto.
    Qed.
  End Six.
End Plane.

(** Three of a kind: vertices, edges, components, indexed around. *)
From Coq Require Import Bool Setoid.
Inductive three := T0 | T1 | T2.
Definition next i := match i with T0 => T1 | T1 => T2 | T2 => T0 end.
Definition every (p : three -> bool) : bool := (p T0 && p T1 && p T2)%bool.
Definition some (p : three -> bool) : bool := (p T0 || p T1 || p T2)%bool.

Inductive triple (A : Type) := Tri (a b c : A).
Arguments Tri {A}.
Definition get {A} (t : triple A) (i : three) : A := let '(Tri a b c) := t in match i with T0 => a | T1 => b | T2 => c end.
Coercion get : triple >-> Funclass.
(** All three are computed when the triple is made. *)
Definition tab {A} (f : three -> A) : triple A := Tri (f T0) (f T1) (f T2).
Lemma get_tab {A} (f : three -> A) i : tab f i = f i.
Proof. now destruct i. Qed.
Lemma every_all p : every p = true <-> forall i, p i = true.
Proof.
  unfold every. rewrite !Bool.andb_true_iff. split; [intros [[A B] C] []; auto|auto].
Qed.
Lemma some_one p : some p = true <-> exists i, p i = true.
Proof.
  unfold some. rewrite !Bool.orb_true_iff. split; [intros [[H|H]|H]; eauto|intros [[] H]; auto].
Qed.

(** Where triangles meet, two edges take part: signs of a common point with at least five missed edges are refuted by
    computation. Section 7.8 of docs/determinants.md. *)
From Coq Require Import List Bool PArith ZArith.
Require Import Efsat.Sign Efsat.Table.
Import ListNotations.
Definition without (k : nat) := firstn k edge_list ++ skipn (S k) edge_list.
Lemma five_refuted : forallb (fun k => refuted 30 (facts ++ hit_list (without k))) (List.seq 0 6) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

"""What replaces python-fcl: all contacts of two meshes in a pose, here exact for the numbers given, with what they share."""

import efsat
import trimesh

a, b = trimesh.creation.icosphere(), trimesh.creation.box()
pose = trimesh.transformations.translation_matrix([1.25, 0.0, 0.0])
collider = efsat.Collider(a, b)  # fcl.BVHModel with beginModel, addSubModel and endModel, fcl.CollisionObject, twice each
contacts = collider.contacts(pose)  # fcl.Transform, fcl.CollisionRequest(num_max_contacts, enable_contact), fcl.collide
segments = collider.segments(contacts.pairs, pose)  # contact.pos, of which fcl has one point
for (p, q), kind, ends in zip(contacts.pairs, contacts.kinds, segments):  # contact.b1, contact.b2
    print(p, q, efsat.KINDS[kind], ends.tolist())
print(collider.touches([pose])[0], collider.solids(pose))  # fcl.collide with a CollisionRequest() of its own; fcl has no solids

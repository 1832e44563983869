"""The hard scenes under scenes/hard, each of which provokes one failure: folder to writer."""
from . import hard_chains, hard_contact, hard_glass, hard_media, hard_mirrors, hard_sizes, hard_triangles

WRITERS = [
    hard_chains.brewster_pair, hard_chains.gold_periscope, hard_chains.glass_gold_gold_glass, hard_chains.mirror_loop,
    hard_mirrors.facing_mirrors, hard_mirrors.paint_under_glass_in_brewster_mirror,
    hard_glass.glass_slab, hard_glass.glass_sphere, hard_glass.fresnel_rhomb,
    hard_sizes.room, hard_sizes.far_away, hard_sizes.tiny,
    hard_contact.thin_slab, hard_contact.touching_bodies,
    hard_media.inside_glass, hard_media.into_the_edge, hard_media.nested_media, hard_media.camera_on_surface,
    hard_media.camera_along_edge,
    hard_triangles.bad_triangles, hard_triangles.slivers,
]
SCENES = {"hard/" + writer.__name__.replace("_", "-"): writer for writer in WRITERS}

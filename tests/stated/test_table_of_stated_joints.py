"""Test that each row of the table of stated joints in docs/formats.md has a test of its own."""

import re
from pathlib import Path

import test_animated as animated
import test_bones as bones
import test_dae_joints as dae
import test_physics_joints as physics

PAGE = (Path(__file__).parents[2] / "docs" / "formats.md").read_text(encoding="utf-8")
ROWS = {
    "rotation about one axis": animated.test_a_door_turns_about_its_nodes_origin,
    "rotation and translation that together are a turn": animated.test_a_turn_and_a_shift_that_are_a_turn_about_another_axis,
    "a turn of 342 degrees or more": animated.test_a_wheel_turns_without_limits,
    "translation along a line": animated.test_a_drawer_slides,
    "parts that touch and always move together (a handle keyed with its door)": (
        animated.test_a_handle_that_is_animated_with_its_door_is_a_part_of_it
    ),
    "a pose at rest that is none of the animation": animated.test_a_pose_at_rest_that_is_none_of_the_animation,
    "several animations of one node": animated.test_several_animations_of_a_node_are_one_joint_over_their_whole_range,
    "STEP, LINEAR and CUBICSPLINE keys": animated.test_steps_and_splines,
    "everything moves (a turntable)": animated.test_a_turntable_is_no_joint_but_a_door_on_it_is,
    "no part is at rest (scissors)": animated.test_scissors_turn_on_the_larger_blade,
    "motion along several axes, on a curve, or in size": animated.test_what_is_no_joint_is_named,
    "`KHR_animation_pointer` to a node": animated.test_a_pointer_stands_for_a_channel,
    "channels of shapes, materials and lights; broken ones": animated.test_broken_and_other_channels_are_counted,
    "DAE channels": dae.test_a_translation,
    "bones that move a part rigidly": bones.test_a_bone_at_rest_gives_the_place_of_the_hinge,
    "bones that bend a mesh, bones of DAE": bones.test_a_bone_that_bends_a_mesh_gives_no_joint,
    "`KHR_physics_rigid_bodies`, `OMI_physics_joint`": physics.test_a_hinge_between_the_world_and_a_door,
    "physics joints of several axes, or closing a loop": physics.test_what_is_no_joint_of_a_tree_is_counted,
    "what follows what (`extras.joint.mimic` of our own GLB)": animated.test_what_follows_in_our_own_glb_moves_by_itself,
    "masses, colliders and drives of physics extensions": physics.test_a_tree_of_bodies_hangs_on_the_largest_if_none_is_static,
    "physics joint and animation": physics.test_a_physics_joint_counts_before_an_animation,
}


def test_each_row_has_a_test():
    section = PAGE.partition("### Animation and joints in files")[2].partition("###")[0]
    rows = re.findall(r"^\| (.+?) \|", section, re.M)[1:]
    assert rows == list(ROWS)
    assert all(callable(test) for test in ROWS.values())

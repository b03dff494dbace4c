# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an object is to which rays, as words of SDL; and what a scene's settings do to a picture that SDL cannot say.

Names: bpy.types.Object.visible_*, is_holdout, is_shadow_catcher; the view layer's holdout and indirect-only. Takes plain
objects and imports nothing of Blender.
"""

# Attribute of an object; the word for what is hidden from these rays.
RAYS = (('visible_camera', 'no_image'), ('visible_shadow', 'no_shadow'), ('visible_glossy', 'no_reflection'),
        ('visible_diffuse', 'no_radiosity'))


def _layer(ob, what, view_layer):
    method = getattr(getattr(ob, 'original', ob), what, None)
    try:
        return bool(method(view_layer=view_layer)) if method is not None else False
    except (RuntimeError, TypeError, ValueError):
        return False


def words(objects, view_layer, losses, where):
    """Words behind an object in SDL, or None if no ray sees it. objects: itself, and what instances it."""
    hidden = [word for name, word in RAYS if not all(getattr(ob, name, True) for ob in objects)]
    through = all(getattr(ob, 'visible_transmission', True) for ob in objects)
    if len(hidden) == len(RAYS) and not through:
        return None
    if not through:
        losses.lost(where, 'Ray Visibility', '-', 'seen through glass, though it is hidden from such rays')
    if 'no_image' not in hidden and any(_layer(ob, 'indirect_only_get', view_layer) for ob in objects):
        hidden.insert(0, 'no_image')
    if any(getattr(ob, 'is_holdout', False) or _layer(ob, 'holdout_get', view_layer) for ob in objects):
        losses.lost(where, 'Holdout', '-', 'a hole in the picture\'s alpha; drawn as it is')
    if any(getattr(ob, 'is_shadow_catcher', False) for ob in objects):
        losses.lost(where, 'Shadow Catcher', '-', 'drawn as it is')
    for ob in objects:
        linking = getattr(ob, 'light_linking', None)
        if linking is not None and (linking.receiver_collection or linking.blocker_collection):
            losses.lost(where, 'Light Linking', '-', 'a lamp that lights or is blocked by some objects only')
    return hidden


def lamp(objects, losses, where):
    """A lamp has no such words."""
    for name, label in (('visible_diffuse', 'Diffuse'), ('visible_glossy', 'Glossy'),
                        ('visible_transmission', 'Transmission')):
        if not all(getattr(ob, name, True) for ob in objects):
            losses.lost(where, 'Ray Visibility', '-', '%s: a lamp is there for all rays or none' % label)


# Nodes of a compositor that leave the picture as it is.
PLAIN_NODES = {'CompositorNodeRLayers', 'CompositorNodeComposite', 'CompositorNodeViewer', 'NodeReroute', 'NodeFrame',
               'NodeGroupOutput', 'CompositorNodeOutputFile', 'CompositorNodeSplitViewer'}


def afterwards(scene, losses):
    """What is done to a picture after rendering, or with several; the scene with its settings still as the user's."""
    render, name = scene.render, scene.name
    tree = getattr(scene, 'compositing_node_group', None) or getattr(scene, 'node_tree', None)
    if render.use_compositing and tree is not None and getattr(scene, 'use_nodes', True):
        for node in tree.nodes:
            if node.bl_idname not in PLAIN_NODES and not node.mute:
                losses.lost(name, 'Compositing', node.name, 'what is done to the picture afterwards')
    editor = getattr(scene, 'sequence_editor', None)
    strips = getattr(editor, 'strips', None) or getattr(editor, 'sequences', None)
    if render.use_sequencer and strips:
        losses.lost(name, 'Sequencer', '-', 'the picture is made of strips')
    if render.use_multiview:
        losses.lost(name, 'Stereoscopy', '-', 'one eye is drawn')
    if render.use_freestyle:
        losses.lost(name, 'Freestyle', '-', 'lines drawn over the picture')
    used = [layer.name for layer in scene.view_layers if layer.use]
    for layer in used[1:]:
        losses.lost(name, 'View Layer', layer, 'another picture of the scene; "%s" is drawn' % used[0])
    view = scene.view_settings
    if view.gamma != 1.0:
        losses.nearest(name, 'Gamma', '-', 'of the view, applied after rendering')
    if view.use_curve_mapping:
        losses.nearest(name, 'Curves', '-', 'of the view, applied after rendering')

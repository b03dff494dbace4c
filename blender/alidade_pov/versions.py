# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What differs between the versions of Blender: the one place that knows.

3.4 is what Debian ships and what the tests run; 4.x renamed the Principled BSDF's sockets (4.0), dropped the split
normals (4.1) and changed the lamps' falloff. Everything here takes the version or a plain object, and imports nothing
of Blender, so that it is tested with stand-ins for the versions that are not at hand.
"""

# What we call an input of the Principled BSDF, and its names from new to old.
PRINCIPLED = {
    'base_color': ('Base Color',),
    'metallic': ('Metallic',),
    'roughness': ('Roughness',),
    'ior': ('IOR',),
    'alpha': ('Alpha',),
    'normal': ('Normal',),
    'specular': ('Specular IOR Level', 'Specular'),
    'specular_tint': ('Specular Tint',),
    'anisotropic': ('Anisotropic',),
    'transmission': ('Transmission Weight', 'Transmission'),
    'transmission_roughness': ('Transmission Roughness',),
    'subsurface': ('Subsurface Weight', 'Subsurface'),
    'subsurface_color': ('Subsurface Color',),
    'coat': ('Coat Weight', 'Coat', 'Clearcoat'),
    'coat_roughness': ('Coat Roughness', 'Clearcoat Roughness'),
    'coat_normal': ('Coat Normal', 'Clearcoat Normal'),
    'coat_tint': ('Coat Tint',),
    'coat_ior': ('Coat IOR',),
    'diffuse_roughness': ('Diffuse Roughness',),
    'sheen': ('Sheen Weight', 'Sheen'),
    'emission': ('Emission Color', 'Emission'),
    'emission_strength': ('Emission Strength',),
    'thin_film': ('Thin Film Thickness',),
}


def find_input(node, *names):
    """The first input of that name which the node has, or None. Names and identifiers both count."""
    inputs = list(node.inputs)
    for name in names:
        for socket in inputs:
            if socket.name == name and getattr(socket, 'enabled', True):
                return socket
    return None


def principled(node, what):
    return find_input(node, *PRINCIPLED[what])


def specular_f0(version, node, ior, level):
    """Reflection of a Principled surface that faces us. Until 4.0 a level of its own, then the IOR's times 2 level."""
    if version < (4, 0, 0):
        return 0.08 * level
    return ((ior - 1.0) / (ior + 1.0)) ** 2 * 2.0 * level


def corner_normals(mesh, version, allocate):
    """Normals of a mesh's corners as a flat float array, from allocate(count)."""
    buffer = allocate(len(mesh.loops) * 3)
    if version >= (4, 1, 0) or (hasattr(mesh, 'corner_normals') and not hasattr(mesh, 'calc_normals_split')):
        mesh.corner_normals.foreach_get('vector', buffer)
        return buffer
    mesh.calc_normals_split()
    mesh.loops.foreach_get('normal', buffer)
    mesh.free_normals_split()
    return buffer


def has_own_normals(mesh, version):
    """Whether corners can differ from both their face's and their vertex's normal."""
    if version >= (4, 1, 0):
        # Flat faces beside smooth ones are enough: their edges are sharp then. That is what Cycles asks, too.
        return mesh.normals_domain == 'CORNER'
    return mesh.has_custom_normals or mesh.use_auto_smooth


def spot_has_cosine(version):
    """Cycles dims a spot with the cosine of the angle from its axis until 4.0."""
    return version < (4, 0, 0)


def lamp_factor(lamp):
    """What newer lamps (4.5) multiply their colour and energy by: exposure and the colour of a temperature."""
    factor = 2.0 ** getattr(lamp, 'exposure', 0.0)
    warmth = getattr(lamp, 'temperature_color', (1.0,) * 3) if getattr(lamp, 'use_temperature', False) else (1.0,) * 3
    return [factor * channel for channel in warmth]


def lamp_is_normalized(lamp):
    """Whether a lamp's energy is that of the whole lamp, whatever its size; only 4.5 can say no."""
    return getattr(lamp, 'normalize', True)


def color_attributes(mesh):
    """The mesh's colour layers by name; and the name of the one that a node without a name means."""
    layers = getattr(mesh, 'color_attributes', None)
    if layers is None:
        return {}, None
    found = {layer.name: layer for layer in layers}
    index = getattr(layers, 'render_color_index', -1)
    names = [layer.name for layer in layers]
    default = names[index] if 0 <= index < len(names) else (names[0] if names else None)
    return found, default

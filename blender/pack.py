# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pack the add-on: pack.py OUT.zip. The same files give the same bytes."""
import os
import sys
import zipfile

here = os.path.dirname(os.path.abspath(__file__))
with zipfile.ZipFile(sys.argv[1], 'w') as archive:
    for name in sorted(os.listdir(os.path.join(here, 'alidade_pov'))):
        if not name.endswith(('.py', '.toml')):
            continue
        entry = zipfile.ZipInfo('alidade_pov/' + name, (1980, 1, 1, 0, 0, 0))
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = 0o644 << 16
        with open(os.path.join(here, 'alidade_pov', name), 'rb') as file:
            archive.writestr(entry, file.read())

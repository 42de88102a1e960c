"""Prints where this Python finds packages below a prefix: package_folder.py PREFIX"""

import os
import site
import sys


def folder(prefix):
    known = [*sys.path, *site.getsitepackages(), site.getusersitepackages()]
    below = [path for path in known if path.endswith("-packages") and os.path.commonpath([path, prefix]) == prefix]
    own = f"lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages"
    # below /usr lies /usr/local too
    return min(below, key=len) if below else os.path.join(prefix, own)


if __name__ == "__main__":
    print(folder(os.path.abspath(sys.argv[1])))

"""Deforming liquid drops with a sharp, conforming interface.

What the program `meniscus` does, from Python::

    import meniscus

    case = meniscus.Case("shear.toml")
    case.set("flow.capillary-number", 0.2)
    with meniscus.Simulation(case, output="out/shear") as simulation:
        simulation.run(until=2.0)
        drop = simulation.interfaces[0]
        print(simulation.t, drop.points.shape, drop.fields["curvature"].max())
        deformation = simulation.drops()["D"]

* ``Case``: a case file, a dict or a text, checked as the program checks it.
* ``Simulation``: a run that goes on step by step.
* ``Run``: the folder of a run, by whichever program it was made.
* ``remesh``: triangulates a closed surface anew.
* ``volume_mesh``: tetrahedra between closed surfaces.
* ``meniscus.plot``: pictures by matplotlib.
* ``explain(key)``: what a key of a case means.

Numbers are dimensionless: lengths in R0, the radius of the drop; times in 1/G, the inverse rate of
the imposed flow; velocities in G R0; pressures and stresses in mu_out G. In a quiescent flow times
are in mu_out R0/sigma and stresses in sigma/R0. A case with a [scale] table takes SI units; what
comes out is dimensionless all the same.

Errors: ``ValueError`` for wrong input, with the program's own line; ``RuntimeError`` where a run or
a mesh cannot go on.
"""
from . import _core
from ._arguments import in_words_of_python, text_of
from ._case import Case
from ._core import Interface, VolumeMesh
from ._meshes import RemeshedSurface, Tetrahedra, remesh, volume_mesh
from ._run import Run, Shape, Volume
from ._simulation import Simulation

__version__: str = _core.version

__all__ = ["Case", "Interface", "RemeshedSurface", "Run", "Shape", "Simulation", "Tetrahedra", "Volume",
           "VolumeMesh", "explain", "remesh", "set_log_level", "volume_mesh"]

Interface.__module__ = VolumeMesh.__module__ = __name__


def explain(key: str = "") -> str:
    """What a key or table of a case means, with type, unit, range and default.

    Takes "drop.nodes", a bare "nodes" or a table "drop"; without a key it lists them all.
    Raises ValueError, with the nearest key, for anything else.
    """
    with in_words_of_python():
        return _core.explain(text_of(key, "key"))


def set_log_level(level: str) -> None:
    """What the library writes to standard error.

    It is "off", "error", "warning" (as at first), "info" or "debug".
    """
    _core.set_log_level(text_of(level, "level"))

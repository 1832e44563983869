"""Responses of surfaces against closed forms and the command."""

import json

import malus
import numpy as np
import pytest
from conftest import run


def fresnel(eta, degrees):
    """r_s and r_p of the field by Born and Wolf, 1.5, with r_p = -r_s at normal incidence."""
    c = np.cos(np.radians(degrees))
    t = np.sqrt(eta**2 - 1 + c**2 + 0j)
    t = np.where(t.imag > 0, -t, t)
    return (c - t) / (c + t), (eta**2 * c - t) / (eta**2 * c + t)


@pytest.mark.parametrize(("eta", "k"), [(1.5, 0), (0.2, 3.4), (1.33, 0)])
def test_mueller_matrices_are_those_of_the_fresnel_equations(eta, k):
    angles = np.linspace(0, 89, 12).reshape(3, 4)
    m = malus.material(eta=eta, k=k).mueller(angles)
    assert m.shape == (3, 4, 4, 4)
    rs, rp = fresnel(eta - 1j * k, angles)
    a, b, x = (abs(rs)**2 + abs(rp)**2) / 2, (abs(rs)**2 - abs(rp)**2) / 2, rp * rs.conj()
    expected = np.zeros((3, 4, 4, 4))
    expected[..., 0, 0] = expected[..., 1, 1] = a
    expected[..., 0, 1] = expected[..., 1, 0] = b
    expected[..., 2, 2] = expected[..., 3, 3] = x.real
    expected[..., 2, 3], expected[..., 3, 2] = -x.imag, x.imag
    np.testing.assert_allclose(m, expected, atol=1e-12)


def test_values_are_those_of_the_command():
    row = json.loads(run("material", "gold", "--wavelength", 600, "--angle", 37, "--json").stdout)
    gold = malus.material("gold")
    np.testing.assert_allclose(gold.mueller(37, wavelength=600).ravel(), row["reflection"], atol=1e-15)
    rs, rp = gold.reflectance([37], wavelength=600)
    np.testing.assert_allclose([rs[0], rp[0]], [row["rs"], row["rp"]])
    assert gold.index(600) == pytest.approx(row["eta"] - 1j * row["k"])


def test_errors():
    with pytest.raises(malus.Error, match="gold"):
        malus.material("gols")
    with pytest.raises(malus.Error, match="angle"):
        malus.material("gold").mueller(91)
    with pytest.raises(malus.Error, match="transmits nothing"):
        malus.material("gold").mueller(10, transmission=True)
    with pytest.raises(ValueError, match="name"):
        malus.material("gold", eta=1.5)
    with pytest.raises(malus.Error):
        malus.material("gold").mueller(10, wavelength=1)


def test_compare_returns_errors_and_times(packs):
    result = malus.compare(packs["glass-wall"], methods=["stokes", "fresnel"], width=48, rounds=2)
    rows = {row["method"]: row for row in result["rows"] if not row.get("isSecondPath")}
    assert {"schlick", "fresnel", "stokes"} <= rows.keys()
    assert len(rows["stokes"]["samplesMs"]) == 2
    assert rows["stokes"]["error"]["relRms"] < rows["fresnel"]["error"]["relRms"]

"""Dynamic lines against closed forms and equations of as many masses, written here anew.

Every clone runs them; the other files of lines compare with reference data as well.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from tests.verification.line_scenes import IDLE, case, frequencies, line, span
from tests.verification.test_lines_in_motion import moved

import hydrodae

G = 9.81


def test_a_taut_string_has_the_frequencies_of_the_closed_form() -> None:
    """omega_k = 2 sqrt(T / (m l)) sin(k pi / 2 n) for n - 1 masses m between n segments l."""
    n, length, unstretched, density, stiffness = 20, 10.0, 9.9, 3.0, 1e4
    keys = span([length, 0.0, 0.0], unstretched, n, density, stiffness)
    _, across = frequencies(keys, "[environment]\ngravity = 0.0\n")
    tension = stiffness * (length / unstretched - 1.0)
    mass = density * unstretched / n
    k = np.arange(1, n)
    exact = 2.0 * np.sqrt(tension / (mass * length / n)) * np.sin(0.5 * np.pi * k / n)
    assert across == pytest.approx(exact, rel=1e-9)


def test_a_hanging_chain_has_the_frequencies_of_as_many_masses() -> None:
    """Each segment carries the weight below it; the free end has half a mass."""
    n, length, density = 20, 5.0, 2.0
    _, across = frequencies(span(None, length, n, density, 1e8))
    mass = np.full(n, density * length / n)
    mass[-1] *= 0.5
    along = (
        np.cumsum(mass[::-1])[::-1] * G / (length / n)
    )  # tension over length, segment by segment
    stiffness = np.diag(along + np.append(along[1:], 0.0))
    stiffness -= np.diag(along[1:], 1) + np.diag(along[1:], -1)
    exact = np.sqrt(np.linalg.eigvalsh(stiffness / np.sqrt(np.outer(mass, mass))))
    assert across == pytest.approx(exact, rel=1e-5)
    # the chain of the textbook: half the first zero of J_0, times sqrt(g / L)
    assert across[0] == pytest.approx(0.5 * 2.404825557695773 * math.sqrt(G / length), rel=1e-3)


def test_a_whirling_rope_keeps_its_shape_for_a_turn() -> None:
    """Masses that turn about the vertical through the pin at 1.2 times the first frequency."""
    n, length, density, stiffness = 8, 5.0, 2.0, 1e5
    turning = 1.2 * 0.5 * 2.404825557695773 * math.sqrt(G / length)
    mass = np.full(n, density * length / n)
    mass[-1] *= 0.5
    part = length / n

    def shape(tip: float) -> tuple[np.ndarray, float]:
        """Radius and height of pin and nodes from the free end up, and the load on the pin."""
        place, pull = [np.array([tip, 0.0])], np.zeros(2)
        for m in mass[::-1]:
            pull = pull + m * np.array([turning**2 * place[-1][0], -G])
            size = float(np.linalg.norm(pull))
            place.append(place[-1] - pull / size * part * (1.0 + size / stiffness))
        pull[1] -= 0.5 * density * part * G  # of the half mass at the pin itself
        return np.array(place[::-1]), float(np.linalg.norm(pull))

    tip = brentq(lambda r: float(shape(r)[0][0, 0]), 0.3 * length, 0.95 * length, xtol=1e-13)
    whole, pinned = shape(tip)
    place = whole[1:] - whole[0]
    keys = span(None, length, n, density, stiffness)
    options = f'end_time = {2.0 * math.pi / turning!r}\nmethod = "radau"\nrtol = 1e-7'
    simulation = hydrodae.Simulation(case(IDLE + line(keys), options))
    state = simulation.state()
    nodes = np.zeros((n, 6))  # place and velocity
    nodes[:, 0], nodes[:, 2], nodes[:, 4] = place[:, 0], place[:, 1], turning * place[:, 0]
    simulation.restore(moved(state, np.concatenate([state.y[: -6 * n], nodes.ravel()])))
    while not simulation.finished:
        simulation.advance()
    again = simulation.state().y[-6 * n :].reshape(n, 6)[:, :3]
    assert again[:, [0, 2]] == pytest.approx(place, abs=1e-5 * length)
    assert np.abs(again[:, 1]).max() < 1e-4 * length
    held = float(np.asarray(simulation.read("forces/line/tension_anchor")))
    assert held == pytest.approx(pinned, rel=1e-5)

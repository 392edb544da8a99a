r"""The PI controller of case.toml as another program, for case_tcp.toml with protocol "hydrodae".

    python cases/control/client.py [PORT] & hydrodae-solve cases/control/case_tcp.toml \
        -o results.h5 --set controller.pi.protocol=hydrodae

It ends with the run.
"""

import argparse

from hydrodae import tcp

GAIN_P, GAIN_I = 600.0, 300.0  # N s/m, N/m


def main(port: int) -> None:
    """Answer until the run ends."""
    integral = 0.0
    with tcp.connect(port=port) as run:
        assert isinstance(run, tcp.Numbered)
        period = run.hello["period"]
        for _, (rate,) in run:
            error = -rate
            run.answer(GAIN_P * error + integral)
            integral += period * GAIN_I * error


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="A PI controller as another program.")
    parser.add_argument("port", nargs="?", type=int, default=50000)
    main(parser.parse_args().port)

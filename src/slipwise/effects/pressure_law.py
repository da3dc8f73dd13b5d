"""Another dependence on pressure than that of the contact area.

    mu *= exp[a L + c L^2],        L = ln(P / P_0)

The saturating area of the paper's law is one idea of why friction falls with pressure. Others: a power P^(e-1) as in a
Hertz contact (c = 0); 0.7^((P - P_0)/50 MPa) (a = -0.12, c = -0.06 around 17 MPa); Constantinou's
mu_0 - dmu tanh(eps P). This form multiplies the law at hand and touches all of them around P_0, where it changes
nothing. Below P_0/50 it stays what it is there.

Valid: P from a few MPa to 50 MPa; near P_0 the slope a is all that can be told.
Source: Dao et al. (2013) for the power, Kumar et al. (2015), Constantinou, Mokha, Reinhorn (1990); the common form and
its values assumed.
"""

from math import exp, log

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter


def shear(shear: float, pressure: float, slope: float, bend: float, rated: float) -> float:
    """Scale the shear strength [Pa] by the pressure's factor."""
    ratio = log(max(pressure / rated, 0.02))
    return shear * exp(slope * ratio + bend * ratio * ratio)


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("slope", "1", -0.1, -3.0, 3.0, 0.0, "Kumar et al. (2015) at 17 MPa: -0.12", "a: exponent at P_0"),
        Parameter("bend", "1", 0.0, -2.0, 2.0, 0.0, "assumed", "c: change of the exponent with ln P"),
        Parameter("rated", "Pa", 16.882e6, 1e6, 100e6, None, "paper: 16.9 MPa at rest", "P_0: changes nothing", "MPa"),
    ),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= exp[a ln(P/P_0) + c ln^2(P/P_0)]",
        moves=RESPONSE,
        signature="odd, a function of pressure only: the slope of the trapezoid is wrong, the mean is right",
        confused_with={
            "contact_area": "only a wide range of pressure tells: sines of equal peak speed and different a_z",
        },
        needs=("changing load",),
    ),
    rare=Rare(steady="the strength of the base law"),
)  # fmt: skip

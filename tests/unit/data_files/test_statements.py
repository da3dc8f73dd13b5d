"""What headers state, in the words of eight languages: step, rate, unit, count and peaks, wherever they stand."""

import pytest

from slipwise.data_files.acceleration_unit import acceleration_factor
from slipwise.data_files.statements import read_statements
from slipwise.errors import InputError

#: line -> step [s], unit as a factor to m/s^2, count.
G, GAL, SI = 9.80665, 0.01, 1.0
PHRASES = [
    # English
    ("Acceleration in g, dt = 0.02 sec", 0.02, G, None),
    ("Points: 160  Rate: 50 sps  Units: cm/sec/sec", 0.02, GAL, 160),
    ("1559 POINTS OF ACCEL DATA EQUALLY SPACED AT  .02 SEC. (UNITS = G)", 0.02, G, 1559),
    ("CORRECTED ACCELERATION 4000 POINTS AT 0.005 SEC INTERVALS, CM/SEC/SEC", 0.005, None, 4000),
    ("Sampled at 200 samples per second, acceleration (m/s^2)", 0.005, SI, None),
    ("Data: 4000 points, DT=0.005", 0.005, None, 4000),
    ("Digitised record, 200 sps", 0.005, None, None),
    ("dt 0.01", 0.01, None, None),
    ("Sampling rate (Hz) 200; acceleration units: G", 0.005, G, None),
    ("time increment = 5 ms", 0.005, None, None),
    ("The record was sampled at 0.01 s", 0.01, None, None),
    ("Sampling frequency: 200", 0.005, None, None),
    ("fs = 100, unit (gal)", 0.01, GAL, None),
    ("The time step is 0.005 s and the acceleration is in cm/s^2", 0.005, GAL, None),
    ("This record is sampled at an interval of 0.01 s; values are in g", 0.01, G, None),
    ("Time interval between samples: 0.02 s", 0.02, None, None),
    ("Sampling interval of data = 0.005 sec, accelerations in gals", 0.005, GAL, None),
    ("200 Hz data, acceleration m/s2", 0.005, SI, None),
    ("Timestep in ms: 10; engineering units: m/s^2", 0.01, SI, None),
    ("One value every 0.01 s; accelerations in cm/s2", 0.01, GAL, None),
    ("Time increment between points = 0.010 seconds, units g", 0.01, G, None),
    ('"Units","m/s²"', None, SI, None),
    ("sampled at 100 Hz, acceleration expressed in milli-g", 0.01, G / 1000, None),
    ("Sampling interval;20;ms", 0.02, None, None),
    ('"Sample period","5","ms"', 0.005, None, None),
    ("dt\t20\tms", 0.02, None, None),
    ("fs,50", 0.02, None, None),
    # Spanish
    ("Aceleración en gales, un dato cada 0.01 s", 0.01, GAL, None),
    ("Los datos están en gal, con un paso de 0,02 s", 0.02, GAL, None),
    ("El intervalo de tiempo entre muestras es de 0.01 segundos", 0.01, None, None),
    ("Frecuencia de muestreo: 50 Hz", 0.02, None, None),
    ("Intervalo de muestreo 0.02 s; Aceleración en cm/s^2", 0.02, GAL, None),
    ("PASO DE TIEMPO (seg): 0,01   UNIDADES: gal   NUMERO DE DATOS: 4000", 0.01, GAL, 4000),
    ("Registro con 200 muestras por segundo", 0.005, None, None),
    # German
    ("Abtastrate: 200 Hz, Einheit: m/s²", 0.005, SI, None),
    ("Zeitschritt = 0,005 s; Beschleunigung in g", 0.005, G, None),
    ("Anzahl der Messwerte: 4000, Abtastfrequenz 100 Hz", 0.01, None, 4000),
    ("Schrittweite 5 ms", 0.005, None, None),
    ("Abtastung mit 200 Hz, Werte in m/s²", 0.005, SI, None),
    ("Akzelerogramm, Δt=0,01 s, Einheit g", 0.01, G, None),
    # Turkish
    ("İvme değerleri cm/s² cinsinden, örnekleme 100 Hz", 0.01, GAL, None),
    ("Örnekleme aralığı: 0.01 sn, Birim: gal", 0.01, GAL, None),
    ("ÖRNEKLEME FREKANSI 100 Hz   İVME (cm/s²)   VERİ SAYISI: 160", 0.01, GAL, 160),
    ("Zaman aralığı (s) = 0.02; ivme birimi: g", 0.02, G, None),
    # Japanese
    ("サンプリング周波数：100Hz　単位：gal", 0.01, GAL, None),
    ("データ数 4000 サンプリング間隔 0.01秒", 0.01, None, 4000),
    ("加速度(gal) 刻み時間Δt=0.01秒", 0.01, GAL, None),
    ("時間刻み 0.005 秒、 加速度の単位 : m/s²", 0.005, SI, None),
    ("単位(gal) サンプリング周波数(Hz) 100", 0.01, GAL, None),
    ("サンプリング周期 10ms 加速度 cm/s2", 0.01, GAL, None),
    ("時間刻み=0.01秒、単位=gal、データ数=200", 0.01, GAL, 200),
    # Chinese
    ("采样频率为200Hz，单位为gal", 0.005, GAL, None),
    ("采样频率：200Hz 单位：cm/s²", 0.005, GAL, None),
    ("时间间隔0.02秒，加速度(gal)", 0.02, GAL, None),
    ("采样率为 50 Hz，数据点数：160", 0.02, None, 160),
    ("時間步長=0.005s 單位：g", 0.005, G, None),
    # Italian
    ("Passo di campionamento: 0,005 s. Accelerazione in cm/s²", 0.005, GAL, None),
    ("Frequenza di campionamento = 200 Hz; unità di misura: g; numero di campioni: 4000", 0.005, G, 4000),
    ("Accelerazione [cm/s^2], passo 0.01 s", 0.01, GAL, None),
    ("dati campionati a 200 Hz, accelerazione in g", 0.005, G, None),
    # French
    ("Le pas de temps est de 0,01 s ; unités : m/s2", 0.01, SI, None),
    ("Échantillonnage : 100 Hz, accélérations en g", 0.01, G, None),
    ("Fréquence d'échantillonnage : 100 Hz ; Unité : m/s2", 0.01, SI, None),
    ("Pas d'échantillonnage 0.01 s, unités en g", 0.01, G, None),
    # Portuguese
    ("Intervalo de amostragem: 0,01 s; unidade: cm/s2", 0.01, GAL, None),
    ("Taxa de amostragem: 100 Hz, aceleração em g", 0.01, G, None),
    ("Pas de temps: 10 ms, nombre de points: 4000, accélération en g", 0.01, G, 4000),
]


@pytest.mark.parametrize(("line", "step", "factor", "count"), PHRASES)
@pytest.mark.parametrize("comment", ["", "# ", "** "])
def test_step_unit_and_count_are_found_in_every_language_and_place(line, step, factor, count, comment):
    stated = read_statements(["A title of 1940", comment + line, "Component: EW"], "f")
    assert stated.step == pytest.approx(step)
    assert (None if stated.unit is None else acceleration_factor(stated.unit, "")) == factor
    assert stated.count == count


@pytest.mark.parametrize(
    ("line", "peaks"),
    [
        (
            "RAW PGA VALUES (gal)    : (N-S) 12.238303 (E-W) 8.223611 (U-D) 2.923994",
            [("N-S", "12.238303", "gal"), ("E-W", "8.223611", "gal"), ("U-D", "2.923994", "gal")],
        ),
        (
            "PGA NS: 12.2 gal EW: 8.2 gal UD: 2.9 gal",
            [("NS", "12.2", "gal"), ("EW", "8.2", "gal"), ("UD", "2.9", "gal")],
        ),
        ("Max acc: 12.2 / 8.2 / 2.9 gal", [("", "12.2", "gal"), ("", "8.2", "gal"), ("", "2.9", "gal")]),
        ("Peak acceleration = -341.695 cm/s/s at 2.12 s", [("", "-341.695", "cm/s/s")]),
        ("N-S PGA = 12.2 gal", [("N-S", "12.2", "gal")]),
        ("最大加速度(gal) NS 12.2 EW 8.2 UD 2.9", [("NS", "12.2", "gal"), ("EW", "8.2", "gal"), ("UD", "2.9", "gal")]),
        ("Aceleración máxima: 0,34 g", [("", "0.34", "g")]),
        ("En büyük ivme (gal): 12.2 (NS), 8.2 (EW)", [("NS", "12.2", "gal"), ("EW", "8.2", "gal")]),
        ("Maximum acceleration is 341.7 cm/s2", [("", "341.7", "cm/s2")]),
        ("accelerazione massima 3,41 m/s²", [("", "3.41", "m/s2")]),
        ("PGA (cm/s2) N-S: 341.7, E-W: 210.1", [("N-S", "341.7", "cm/s2"), ("E-W", "210.1", "cm/s2")]),
        ("Spitzenwert = 3.4 m/s²", [("", "3.4", "m/s2")]),
        ("Spitzenwerte: NS 3.4 m/s², EW 2.1 m/s²", [("NS", "3.4", "m/s2"), ("EW", "2.1", "m/s2")]),
        ("PGA (NS/EW): 12.2/8.2 gal", [("NS", "12.2", "gal"), ("EW", "8.2", "gal")]),
        ("Acel. max. N-S: 11.63 gal", [("N-S", "11.63", "gal")]),
        ("峰值加速度(gal)：东西 11.6 竖向 8.2", [("东西", "11.6", "gal"), ("竖向", "8.2", "gal")]),
        ("峰值加速度：0.2g", [("", "0.2", "g")]),
        ("PEAK VALUES : ACCEL = 341.695 CM/SEC/SEC", [("", "341.695", "CM/SEC/SEC")]),
    ],
)
def test_peaks_of_one_or_several_components_are_found(line, peaks):
    assert [(peak.label, peak.text, peak.unit) for peak in read_statements([line], "f").peaks] == peaks


@pytest.mark.parametrize(
    "line",
    [
        "Original sampling rate: 200 Hz",
        "Delta: 45 km",
        "8 values a line, 10 points per line",
        "Accelerogram of A. B. City, 1999",
        "Peak ground acceleration of the 1940 El Centro earthquake",
        "Step: 3",
        "Step 3 of 5",
        "one station every 10 km, checked every 2 years",
        "every 20 s a photo was taken",
        "Power unit G of the plant, basement",
        "Anti-alias filter rate: 50 Hz",
        "Number of samples lost: 0",
        "Low-pass 25 Hz, high-pass 0.1 Hz",
    ],
)
def test_what_only_looks_like_a_statement_states_nothing(line):
    stated = read_statements([line], "f")
    assert (stated.step, stated.unit, stated.count, stated.peaks) == (None, None, None, ())


@pytest.mark.parametrize(
    ("one", "two"),
    [
        ("dt = 0.02 s", "Frecuencia de muestreo: 100 Hz"),
        ("Abtastrate: 200 Hz", "Zeitschritt 0.02 s"),
        ("单位：gal", "acceleration in g"),
        ("NPTS= 160", "numero di punti: 159"),
    ],
)
def test_statements_that_contradict_each_other_are_refused_quoting_both(one, two):
    with pytest.raises(InputError, match="the header contradicts itself") as refused:
        read_statements([one, "between them", two], "record.txt")
    assert one in str(refused.value)
    assert two in str(refused.value)


def test_a_rate_that_is_rounded_agrees_with_its_step():
    assert read_statements(["rate: 119.9 Hz", "dt = 0.00834 s"], "f").step == pytest.approx(1 / 119.9, rel=2e-3)


def test_two_spellings_of_one_unit_do_not_contradict_each_other():
    assert read_statements(["units: gal", "acceleration in cm/s2"], "f").unit == "gal"

"""What the words in a column's name mean, in the languages of laboratories: "Reibkraft" is a friction and a force."""

import re
import unicodedata
from collections.abc import Iterable
from functools import cache

#: Meaning -> words without accents, in lower case; "kraft*" begins with it, "*kraft" ends with it. Words of Chinese and
#: Japanese, which stand without blanks, are found anywhere.
_MEANINGS: dict[str, str] = {
    # quantities
    "time": "time zeit* *zeit *zeitstempel tempo temps tiempo zaman timestamp t sec secs seconds clock elapsed hora"
    " millis* milis* micros 時間 時刻 时间"
    " время 시간",
    "acceleration": "acc acc* accel* ax ay az beschl* acel* ivme* 加速度"
    " ускорение 가속도",
    "speed": "vel vel* speed speed* geschw* *geschw* vitesse* velocid* velocita hiz* v vx vslip rate 速度 速率"
    " скорость 속도",
    "length": "disp disp* displ* slip slip* stroke* position* pos travel weg* *weg verschieb* hub desplaz* despl* depl*"
    " carrera course spost* corsa desloc* deplasman* degistirme otelenme lvdt* x s u dx distance* strecke distancia"
    " mesafe extension crosshead ram piston laser 変位 位移 行程"
    " перемещение смещение 변위",
    "force": "force* kraft* *kraft fuerza* forza* forca* effort* kuvvet* f fx fy fz ft fn fr ff fh fv 力"
    " сила усилие",
    "loading": "load load* last* *last carga* charge* carico yuk* lc lc* loadcell 荷重 载荷 荷载 載荷"
    " нагрузка 하중",
    "pressure": "pressure* *pressure druck* *druck presion* pression* pressione pressao basinc* p stress* spannung*"
    " sigma* tau contrainte* tension* tensao* tensione 圧力 压力 压强 面圧 应力 応力"
    " давление напряжение 압력 응력",
    "temperature": "temp temper* *temperatur sicaklik* 温度 溫度"
    " температура 온도",
    "coefficient": "cof mu μ coefficient* koeff* reibwert* reibbeiwert* reibungszahl coeff* coef* katsayi* 係数 系数",
    # what a force does
    "load": "normal* axial* vert* *vertikal n fn fz fv z auflast* dusey* druckkraft eksenel compression* 鉛直 竖向 垂直"
    " 法向 轴向 軸"
    " вертикальн нормальн 수직",
    "friction": "fric* reib* frot* frott* attrit* atrit* surtunme* shear* schub* scher* quer* cortante taglio cisail*"
    " lateral* latera* tangent* *tangential traction fx ft fr ff fh h hor horiz* horz* yatay tau 摩擦 水平 剪 切向 横"
    " трени горизонтальн касательн 마찰 수평",
    # where it is, and in which direction
    "table": "table* tab tbl base platform shaker actuator tisch* ground foundation mesa tavola tabla"
    " 振動台 台面 振动台",
    "girder": "girder* deck* beam* mass block* superstructure top slab bridge traeger* trager* gir tablero viga trave"
    " kiris 桁 主梁 上部",
    "up": "z vert* v up n normal* axial* az fz *vertikal dusey 鉛直 竖向 垂直 上下"
    " вертикальн нормальн 수직",
    "along": "x long* h hor horz* horiz* shear* ax fx friction* quer* lateral* yatay 水平"
    " горизонтальн 수평",
    "across": "y trans transverse ay fy across enine",
    # what is no measured channel of a rig
    "command": "command* cmd setpoint* set soll* target* demand* desired consigne consigna ref reference* nominal*"
    " komut 指令 目標 目标 設定",
    "count": "no nr number index sample samples count* counter cycle* cycles lap laps record rec row scan id step point"
    " nummer zeile lfd numero indice sira 番号 序号 編號 データ番号",
    "surroundings": "room ambient raum* umgebung* oil oel hydraulic* chamber outside oda 室温 气温 気温",
    "wear": "wear* penetration depth verschleiss* thickness gap uplift dicke aşınma asinma usure desgaste 摩耗 磨损",
    "path": "distance* path cumulative total strecke distancia 距離 距离",
}  # fmt: skip
#: Where one word ends and the next begins without a blank: AccDeckX, LC1.
_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=\d)(?=[A-Za-z])|(?<=[A-Za-z])(?=\d)")


def words_of(name: str) -> tuple[str, ...]:
    """Return the words of a name in lower case, without accents: "AccDeckX" and "acc_deck_x" are acc, deck and x."""
    plain = "".join(map(_plain, name))
    return tuple(word for word in re.split(r"[\W_]+", _CAMEL.sub(" ", plain).casefold()) if word)


def _plain(character: str) -> str:
    """Return a Latin letter without its accent; what other scripts put beside their letters is part of them."""
    taken_apart = unicodedata.normalize("NFKD", character)
    return {"ı": "i", "ß": "ss"}.get(character, taken_apart[0] if taken_apart[:1].isascii() else character)


def meanings_of(words: Iterable[str]) -> frozenset[str]:
    """Return what words mean: "friction", "force", "time", "table", "up" and so on."""
    found = [word for word in words if not word.isdigit()]
    return frozenset(meaning for meaning in _MEANINGS if any(_means(word, meaning) for word in found))


@cache
def _means(word: str, meaning: str) -> bool:
    for known in _MEANINGS[meaning].split():
        if not known.isascii() and known != "μ":
            hit = known in word
        elif known.startswith("*"):
            hit = known.strip("*") in word if known.endswith("*") else word.endswith(known[1:])
        else:
            hit = word.startswith(known[:-1]) if known.endswith("*") else word == known
        if hit:
            return True
    return False

"""Tables as people write them, drawn when rules stood: 28 of 33 were right at once, then 21 of 23, then 19 of 20."""

from unit.campaign.tables_as_written import FK, LOADS_FIRST, NK, ONE, TWO, F, N, T, V, Written, X, girder, plain

KN = "kN,kN,kN,kN"
PRESSED = {**TWO, "pad_A_P": TWO["pad_A_N"] / 1e-4}


def each(form: str, numbers: str = "1234") -> str:
    """One name for each pad."""
    return ",".join(form.format(number) for number in numbers)


def later_tables() -> list[Written]:
    """Thirty-three of them, of every kind that is text."""
    return [
        plain(
            "spelled units",
            "Elapsed time,Ram position,Shear load,Normal load\nseconds,millimetres,newtons,newtons",
            TWO,
            T,
            X,
            F,
            N,
        ),
        plain(
            "count and micrometres",
            "Point;Zeit [ms];Verschiebung [µm];Querkraft [N];Auflast [kN]",
            TWO,
            ("", "index"),
            ("time", "ms"),
            ("slip_x", "um"),
            F,
            NK,
            decimal=",",
        ),
        plain("capitals in rows", "TIME\tDISPL\tFRICT\tNLOAD\nSEC\tMM\tKN\tKN", TWO, T, X, FK, NK),
        plain("symbols in brackets", "t [s],u [mm],H [kN],V [kN]", TWO, T, X, FK, NK),
        plain("abbreviations", "Time(s),Disp.(mm),Hor.Force(kN),Ver.Force(kN)", TWO, T, X, FK, NK),
        plain("no blank before the unit", "time[s];pos[mm];Ff[N];Fn[N]", TWO, T, X, F, N),
        plain("Spanish rows", "Tiempo,Deslizamiento,Fuerza horizontal,Fuerza vertical\ns,mm,kN,kN", TWO, T, X, FK, NK),
        plain("French", "Temps;Course (mm);Effort tangentiel (N);Effort normal (N)", TWO, T, X, F, N, decimal=","),
        plain("load cell and actuator", "Load Cell (N),Actuator (mm),Vertical Load (kN),Time (s)", TWO, F, X, NK, T),
        plain(
            "actuator of a machine",
            "Time,Actuator Disp,Actuator Force,Vertical Force\nsec,in,kip,kip",
            TWO,
            T,
            ("slip_x", "in"),
            ("pad_A_Fx", "kip"),
            ("pad_A_N", "kip"),
        ),
        plain(
            "MTS with both directions",
            "Axial Count,Time,Axial Displacement,Axial Force,Lateral Force,Lateral Displacement\n,s,mm,kN,kN,mm",
            TWO,
            ("", "index"),
            T,
            ("", "up"),
            NK,
            FK,
            X,
        ),
        plain(
            "micrometres after underscores",
            "time_ms,disp_um,fric_N,load_N",
            TWO,
            ("time", "ms"),
            ("slip_x", "um"),
            F,
            N,
        ),
        plain("subscripts", "t (s),x (m),F_t (N),F_n (N)", TWO, T, ("slip_x", "m"), F, N),
        plain(
            "coefficient in German", "Zeit [s];Reibwert [-];Normalkraft [N];Weg [mm]", ONE, T, ("pad_A_Fx", "1"), N, X
        ),
        plain("tribometer with COF", "Time,Velocity,COF,Normal Force\ns,mm/s,-,N", ONE, T, V, ("pad_A_Fx", "1"), N),
        plain(
            "rotating tribometer",
            "Time (s),Speed (rpm),Radius (mm),Friction Force (N),Load (N),Linear Speed (m/s)",
            ONE,
            T,
            ("", "up"),
            ("", "zero"),
            F,
            N,
            ("slip_vx", "m/s"),
        ),
        plain("Chinese rows", "时间,滑移,剪力,轴力\ns,mm,kN,kN", TWO, T, X, FK, NK),
        plain("Japanese in round brackets", "経過時間(s),すべり変位(mm),せん断力(N),垂直荷重(N)", TWO, T, X, F, N),
        plain(
            "scanner channels", "Scan;Time;Chan 101 (mm);Chan 102 (kN);Chan 103 (kN)", TWO, ("", "index"), T, X, FK, NK
        ),
        plain("one word for date and time", "DateTime,Slip_mm,Friction_kN,Normal_kN", TWO, T, X, FK, NK),
        plain("bare words", "time,disp,force,load", TWO, T, X, F, N),
        plain(
            "commanded and measured",
            "Time [s];Commanded position [mm];Measured position [mm];Commanded load [N];Measured load [N];Friction [N]",
            TWO,
            T,
            ("", "command"),
            X,
            ("", "command"),
            N,
            F,
        ),
        plain("LabVIEW", "X_Value,Displacement,Force X,Force Z", TWO, T, X, F, N),
        plain("only units as names", "Seconds,Millimeters,Newtons (friction),Newtons (normal)", TWO, T, X, F, N),
        plain(
            "units in round brackets",
            "Time;Displacement;Friction force;Normal force\n(s);(mm);(N);(N)",
            TWO,
            T,
            X,
            F,
            N,
            below=";;;\nCreated by: N.N.;;;\n",
        ),
        plain(
            "statistics below",
            "Time (s),Slip (mm),Friction (N),Normal (N)",
            TWO,
            T,
            X,
            F,
            N,
            below="Std,3.5,42,0.9\nCount,240,240,240\n,,,\n",
        ),
        plain("Italian", "Tempo / s;Scorrimento / mm;Taglio / kN;Carico assiale / kN", TWO, T, X, FK, NK, decimal=","),
        plain("symbols and commas", "t, s;s, mm;F_R, N;F_N, N", TWO, T, X, F, N, decimal=","),
        plain("French snake case", "temps,deplacement,force_frottement,force_normale", TWO, T, X, F, N),
        plain("three forces", "Time (s),Fx (N),Fy (N),Fz (N),pos (mm)", TWO, T, F, ("", "up"), N, X),
        plain("lower case one way", "time,fx,fz,v", ONE, T, F, N, V),
        plain("Turkish", "Zaman [s];Kayma [mm];Kesme kuvveti [kN];Eksenel yük [kN]", TWO, T, X, FK, NK),
        plain("units above", "s,mm,N,N\ntime,slip,Fx,Fz", TWO, T, X, F, N),
    ]


def last_tables() -> list[Written]:
    """Twenty-three more."""
    return [
        plain("rows of a force and a way", "Time;Kraft;Weg\ns;kN;mm", TWO, T, FK, X),
        plain("symbols in two rows", "t,Q,N,u\ns,kN,kN,mm", TWO, T, FK, NK, X),
        plain(
            "wanted and measured load",
            "Zeit [s];Normalkraft soll [N];Normalkraft ist [N];Reibkraft [N];Position [mm]",
            TWO,
            T,
            ("", "command"),
            N,
            F,
            X,
        ),
        plain(
            "table and slip",
            "time (sec),table disp (mm),slip (mm),shear (kN),axial (kN)",
            TWO,
            T,
            ("", "zero"),
            X,
            FK,
            NK,
        ),
        plain(
            "depth and coefficient",
            "Time [s],Load [N],Depth [um],Friction [N],COF,Position [mm]",
            TWO,
            T,
            N,
            ("", "up"),
            F,
            ("", "room"),
            X,
        ),
        plain("cycles", "Time,Cycle,Position,Friction,Normal\ns,-,mm,N,N", TWO, T, ("", "index"), X, F, N),
        plain("blanks before commas", "TIME(s) ,FH(kN) ,FV(kN) ,DH(mm)", TWO, T, FK, NK, X),
        plain(
            "one force beside a load", "Tiempo (s);Fuerza (kN);Carga (kN);Desp. (mm)", TWO, T, FK, NK, X, decimal=","
        ),
        plain("symbols with a direction", "time,v_x,F_x,F_z", ONE, T, V, F, N),
        plain("torque beside", "Time [s],Torque [Nm],Speed [mm/s],Friction [N],Load [N]", ONE, T, ("", "up"), V, F, N),
        plain("units as last words", "time s,velocity mm/s,friction N,load N", ONE, T, V, F, N),
        plain("x in millimetres", "time,x mm,Fx kN,Fz kN", TWO, T, X, FK, NK),
        plain(
            "pressure for a load",
            "Time (s),Pressure (MPa),Friction (N),Slip (mm)",
            PRESSED,
            T,
            ("pad_A_P", "MPa"),
            F,
            X,
        ),
        plain("numbered channels", "Time,Ch1,Ch2,Ch3\ns,mm,N,N", TWO, T, X, F, N),
        plain("numbered load cells", "ts,pos,load_cell_1,load_cell_2\ns,mm,N,N", TWO, T, X, F, N),
        plain(
            "both directions",
            "Time (s),Horizontal displacement (mm),Vertical displacement (mm),Horizontal load (kN),Vertical load (kN)",
            TWO,
            T,
            X,
            ("", "up"),
            FK,
            NK,
        ),
        plain("Russian", "время (с);смещение (мм);сила трения (Н);нагрузка (Н)", TWO, T, X, F, N),
        plain(
            "Japanese actuator", "時間(s),アクチュエータ変位(mm),アクチュエータ荷重(kN),鉛直荷重(kN)", TWO, T, X, FK, NK
        ),
        plain("Korean", "시간(s),변위(mm),마찰력(N),수직하중(N)", TWO, T, X, F, N),
        plain("stresses", "t_s,slip_mm,tau_kPa,sigma_n_MPa", ONE, T, X, ("", "up"), ("pad_A_P", "MPa")),
        plain(
            "targets and measured",
            "Time (s),Measured Force X (N),Target Force Z (N),Measured Force Z (N),Stage X (mm)",
            TWO,
            T,
            F,
            ("", "command"),
            N,
            X,
        ),
        plain("an empty row", "Time;Displacement;Force;Vertical load\n[s];[mm];[kN];[kN]", TWO, T, X, FK, NK),
        plain("index before the time", "Index,Time[s],Disp[mm],Force[N]", TWO, ("", "index"), T, X, F),
    ]


def newest_tables() -> list[Written]:
    """Nineteen more, girders among them."""
    return [
        girder(
            "girder in plain English",
            f"Time (s),Table acc (g),Deck acc (g),Slip (mm),{each('Vertical load {} (kN)')},{each('Shear {} (kN)')}",
            "g",
            *LOADS_FIRST,
        ),
        girder(
            "girder in symbols",
            f"t,at,ag,u,{each('N{}')},{each('F{}')}\ns,m/s2,m/s2,mm,{KN},{KN}",
            "m/s^2",
            *LOADS_FIRST,
        ),
        girder(
            "girder in Japanese",
            f"時間(s),振動台加速度(g),桁加速度(g),相対変位(mm),{each('鉛直荷重{}(kN)')},{each('水平荷重{}(kN)')}",
            "g",
            *LOADS_FIRST,
        ),
        girder(
            "girder in French",
            "Temps;Accélération table;Accélération tablier;Déplacement relatif;"
            f"{each('Effort vertical {}')},{each('Effort horizontal {}')}\ns,g,g,mm,{KN},{KN}".replace(",", ";"),
            "g",
            *LOADS_FIRST,
        ),
        girder(
            "girder by letters",
            f"Time,Base_X,Mass_X,LVDT,{each('LC_{}_Z', 'ABCD')},{each('LC_{}_X', 'ABCD')}\ns,g,g,mm,{KN},{KN}",
            "g",
            *LOADS_FIRST,
        ),
        plain("static load", "Time (s),Slip (mm),Force (kN),Static load (kN)", TWO, T, X, FK, NK),
        plain(
            "coefficient in snake case",
            "time,displacement,friction_coefficient,normal_force\ns,mm,,N",
            ONE,
            T,
            X,
            ("pad_A_Fx", "1"),
            N,
        ),
        plain("sled", "Time [s]\tSled position [mm]\tPull force [N]\tDead weight [N]", ONE, T, X, F, N),
        plain("pull force and weight", "Time (s),Pull force (N),Weight (N),Velocity (mm/s)", ONE, T, F, N, V),
        plain(
            "micrometres",
            "Timestamp (ms);Position (µm);Tangential force (N);Normal force (N)",
            TWO,
            ("time", "ms"),
            ("slip_x", "um"),
            F,
            N,
        ),
        plain(
            "German feed", "Laufzeit [s];Verfahrweg [mm];Zugkraft [N];Anpresskraft [N]", ONE, T, X, F, N, decimal=","
        ),
        plain("Italian in brackets", "Tempo(s);Corsa(mm);Forza orizzontale(kN);Forza verticale(kN)", TWO, T, X, FK, NK),
        plain("an empty last column", "Time,Disp,Force,\ns,mm,kN,", TWO, T, X, FK, tail=","),
        plain("snake case with a stamp", "time_stamp,stroke_mm,shear_kN,axial_kN", TWO, T, X, FK, NK),
        plain(
            "jack and load cell",
            "Elapsed (s),Actuator LVDT (mm),Actuator load cell (kN),Vertical jack (kN)",
            TWO,
            T,
            X,
            FK,
            NK,
        ),
        plain("date and time in one", "Date/Time,Slip [mm],Friction [kN],Load [kN]", TWO, T, X, FK, NK),
        plain("directions in letters", "Zeit,Weg,Kraft h,Kraft v\ns,mm,kN,kN", TWO, T, X, FK, NK),
        plain("numbered gauges", "t(s),D1(mm),F1(kN),F2(kN)", TWO, T, X, FK, NK),
        plain("a hash before the names", "# time[s],slip[mm],friction[N],normal[N]", TWO, T, X, F, N),
        plain("rate as key and value", "Slip_mm,Friction_N,Load_N", TWO, X, F, N, above="fs,50\n"),
        plain("French rate", "Déplacement (mm);Frottement (N);Charge (N)", TWO, X, F, N,
              above="Fréquence d'acquisition : 50 Hz\n"),
        plain("a drive along the machine's Y", "T (sec)\tFx (N)\tFz (N)\tY (mm)", TWO, T, F, N, X),
        plain("statistics in fewer columns", "Time (s),Slip (mm),Friction (N),Load (N)", TWO, T, X, F, N,
              below="\n\nStatistics\nMin,Max,Mean\n-5,5,0\n"),
    ]  # fmt: skip

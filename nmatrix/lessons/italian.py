"""The sentences of mistakes in Italian: what was done, and the rule that it broke."""

from __future__ import annotations

from nmatrix.lessons.check.mistake import MistakeId

ITALIAN: dict[MistakeId, tuple[str, str]] = {
    MistakeId.NOT_TRANSPOSED: (
        "Hai invertito la matrice e non l’hai trasposta.",
        "Le normali si trasformano con l’inversa trasposta A⁻ᵀ; A⁻¹ da sola le gira dalla parte "
        "sbagliata ovunque A non sia simmetrica.",
    ),
    MistakeId.NOT_INVERTED: (
        "Hai trasposto la matrice e non l’hai invertita.",
        "Le normali si trasformano con l’inversa trasposta A⁻ᵀ: trasporre annulla la rotazione, "
        "invertire annulla tutto, e le due cose insieme annullano solo la scala.",
    ),
    MistakeId.USED_WORLD_MATRIX: (
        "Hai usato la matrice stessa.",
        "La matrice che muove i punti porta le normali solo dove ruota e scala ugualmente in tutte "
        "le direzioni; luce e occhio raggiungono lo spazio oggetto con la sua inversa.",
    ),
    MistakeId.TRANSPOSED_LAYOUT: (
        "Hai usato la matrice trasposta: ci sono righe dove vanno colonne.",
        "I vettori colonna si moltiplicano da sinistra e la traslazione è l’ultima colonna; "
        "l’ordine in memoria è un’altra cosa, e --input-layout column-major lo legge.",
    ),
    MistakeId.MISSING_NORMALISE: (
        "La direzione è giusta e la sua lunghezza non è 1.",
        "Era chiesto un versore: dividi per la lunghezza, che l’inversa trasposta cambia.",
    ),
    MistakeId.COFACTOR_SIGN: (
        "Ogni numero ha il segno sbagliato: sono i semplici cofattori di una riflessione.",
        "La matrice dei cofattori è det(A)·A⁻ᵀ, e qui det(A) < 0: moltiplica per il segno del "
        "determinante, altrimenti le normali puntano verso l’interno.",
    ),
    MistakeId.TRANSLATED: (
        "Hai mosso la normale come un punto, con w = 1, e così si è aggiunta la traslazione.",
        "Una normale è una direzione: prendi il blocco 3×3, oppure w = 0.",
    ),
    MistakeId.FOUR_COMPONENT_NORMALISE: (
        "Hai normalizzato quattro componenti: la quarta, −(A⁻¹t)·n, è entrata nella lunghezza.",
        "L’inversa trasposta di una matrice che trasla lascia qualcosa in w: toglilo prima di "
        "normalizzare.",
    ),
    MistakeId.USED_MODEL_VIEW: (
        "Hai usato V·M dove va una sola delle due.",
        "La matrice mondo M è per ciò che è fissato all’oggetto; una luce o un occhio del mondo si "
        "muovono con la sola V, una normale nello spazio mondo con la sola M.",
    ),
    MistakeId.DIRECTION_AS_POINT: (
        "Hai mosso la direzione come un punto, con w = 1, e così si è aggiunta la traslazione.",
        "Una direzione ha w = 0: ruota e si scala, e non ha un posto.",
    ),
    MistakeId.COURSE_LIGHT_RULE: (
        "Hai mosso la direzione della luce con l’inversa trasposta (nello spazio oggetto: con Mᵀ).",
        "Questa è la regola delle normali; la direzione di una luce è un vettore e si muove con la "
        "matrice stessa (nello spazio oggetto: con M⁻¹).",
    ),
    MistakeId.DEGREES_AS_RADIANS: (
        "Hai preso gradi per radianti, o radianti per gradi.",
        "Seno e tangente vogliono radianti: moltiplica i gradi per π/180, una volta.",
    ),
    MistakeId.ROTATION_ORDER: (
        "Hai moltiplicato le rotazioni in un altro ordine.",
        "Le rotazioni non commutano; XYZ vuol dire R = Rx·Ry·Rz, quindi il vettore incontra prima "
        "Rz.",
    ),
    MistakeId.ROTATION_SIGN: (
        "Hai ruotato dall’altra parte attorno ad almeno un asse.",
        "Per la regola della mano destra Rz ha −sin nella prima riga; Ry lo ha nell’ultima.",
    ),
    MistakeId.POLIMI_ANGLES_SWAPPED: (
        "Hai preso i tre angoli secondo un’altra convenzione.",
        "Qui ruotano attorno a x, y, z; la libreria del corso ruota attorno a y con il primo e "
        "attorno a x con il secondo, i suoi laboratori anche con altri segni.",
    ),
    MistakeId.WRONG_HANDEDNESS: (
        "Hai preso l’altra mano: la camera guarda lungo l’altra z.",
        "Una camera destrorsa guarda verso −z, una sinistrorsa verso +z; vista e proiezione devono "
        "essere d’accordo.",
    ),
    MistakeId.DEPTH_RANGE: (
        "Hai preso un altro intervallo di profondità.",
        "OpenGL porta near e far in −1 e 1, Vulkan e Direct3D in 0 e 1, la profondità invertita in "
        "1 e 0.",
    ),
    MistakeId.ASPECT_INVERTED: (
        "Hai moltiplicato per il rapporto d’aspetto invece di dividere, o hai preso altezza su "
        "larghezza.",
        "Il rapporto è larghezza su altezza, e divide il primo numero.",
    ),
    MistakeId.HORIZONTAL_FOV: (
        "Hai preso il campo visivo per quello orizzontale.",
        "È verticale: dà il secondo numero della diagonale, e il rapporto d’aspetto il primo.",
    ),
    MistakeId.NEAR_FAR_SWAPPED: (
        "Hai scambiato near e far.",
        "Nella terza riga far viene prima: (f + n)/(f − n), o f/(f − n); fatto apposta si chiama "
        "profondità invertita.",
    ),
    MistakeId.SCALE_BEFORE_TRANSLATE: (
        "Hai moltiplicato la traslazione e il resto nell’ordine sbagliato.",
        "In M = T·A la traslazione viene per ultima e resta com’è; in V = R·T viene prima e viene "
        "ruotata: una matrice a sinistra agisce su tutto ciò che ha a destra.",
    ),
    MistakeId.VIEW_NOT_INVERTED: (
        "Hai dato la posa della camera invece della sua inversa.",
        "La matrice di vista porta il mondo alla camera, quindi annulla dove sta la camera: "
        "R⁻¹·T(−eye).",
    ),
    MistakeId.CLIP_Y: (
        "Hai lasciato fuori il ribaltamento di y nello spazio clip, o l’hai fatto dove non va.",
        "In Vulkan la y dello spazio clip punta in basso, quindi la seconda riga è negata; in "
        "OpenGL, Direct3D, Metal e WebGPU punta in alto.",
    ),
    MistakeId.VIEW_TRANSLATION: (
        "L’ultima colonna non è −R·eye: ci sta l’occhio o il bersaglio, o l’ha ruotata Rᵀ.",
        "V = R·T(−eye): l’occhio viene ruotato con tutto il resto, così V lo porta nell’origine.",
    ),
    MistakeId.VIEW_ROTATION_TRANSPOSED: (
        "Il blocco 3×3 è trasposto: gli assi della camera stanno nelle sue colonne.",
        "La matrice di vista misura lungo gli assi della camera, quindi destra, alto e dietro sono "
        "le sue righe.",
    ),
    MistakeId.VIEW_TRANSLATION_SIGN: (
        "I segni dell’ultima colonna sono rovesciati.",
        "Ogni suo numero è −dot(asse, eye): il mondo si muove contro l’obiettivo.",
    ),
    MistakeId.CAMERA_AXES: (
        "Hai preso gli assi della camera come li ha OpenCV: y in basso e z in avanti.",
        "Qui una camera ha y in alto e guarda verso −z, una sinistrorsa verso +z: nega le righe di "
        "V che differiscono.",
    ),
    MistakeId.HALF_ANGLE: (
        "Hai preso la tangente di tutto il campo visivo, o l’hai dimezzato due volte.",
        "La lunghezza focale è 1/tan(fov/2): metà del campo sta sopra l’asse.",
    ),
    MistakeId.FOCAL_INVERTED: (
        "Hai preso tan(fov/2) per la lunghezza focale.",
        "La lunghezza focale è il suo reciproco, 1/tan(fov/2): un campo più largo fa le cose più "
        "piccole.",
    ),
    MistakeId.ASPECT_MISSING: (
        "Hai lasciato fuori il rapporto d’aspetto.",
        "Il primo numero è la lunghezza focale divisa per larghezza su altezza.",
    ),
    MistakeId.PERSPECTIVE_ROW: (
        "L’ultima riga ha il segno sbagliato, o non è quella di una prospettiva.",
        "Rende w la distanza davanti alla camera: 0 0 −1 0 dove questa guarda verso −z, 0 0 1 0 "
        "dove guarda verso +z.",
    ),
    MistakeId.DEPTH_SIGN: (
        "Uno o entrambi i segni della terza riga sono rovesciati.",
        "La riga porta le due distanze near e far ai due estremi dell’intervallo di profondità: "
        "mettile dentro e guarda.",
    ),
    MistakeId.DEPTH_FACTOR: (
        "Il fattore di fn/(f − n) è sbagliato, o la terza riga è 0.",
        "Da −1 a 1 è 2fn/(f − n), da 0 a 1 fn/(f − n); una riga di zeri non conserva profondità.",
    ),
    MistakeId.SCALE_AFTER_ROTATION: (
        "Hai scalato dopo aver ruotato, S·R invece di R·S.",
        "In M = T·R·S la scala viene prima e agisce lungo gli assi dell’oggetto.",
    ),
    MistakeId.TRANSLATION_MISSING: (
        "Manca la traslazione.",
        "È l’ultima colonna: una matrice senza di essa lascia l’origine dov’è.",
    ),
    MistakeId.ROTATION_MISSING: (
        "Manca la rotazione.",
        "Il blocco 3×3 è un prodotto che ha la rotazione tra i fattori.",
    ),
    MistakeId.SCALE_MISSING: (
        "Manca la scala, o un solo fattore è stato preso per tutti e tre gli assi.",
        "Ogni asse ha il suo fattore, che moltiplica la sua colonna del blocco 3×3.",
    ),
    MistakeId.WORLD_INVERTED: (
        "Hai dato l’inversa: porta dal mondo all’oggetto.",
        "La matrice mondo porta i punti dell’oggetto nel mondo, M = T·R·S.",
    ),
    MistakeId.QUATERNION_ORDER: (
        "Hai letto il quaternione in un altro ordine: il suo w sta altrove.",
        "Qui un quaternione è x y z w, con w per ultimo; altri programmi scrivono w x y z.",
    ),
    MistakeId.QUATERNION_LENGTH: (
        "Hai usato il quaternione senza portarlo a lunghezza 1.",
        "Le formule della matrice valgono per lunghezza 1: dividi i quattro numeri per la loro "
        "lunghezza.",
    ),
    MistakeId.AXES_CONJUGATED: (
        "Hai dato F·M·F, lo stesso cambio di assi da entrambe le parti di M.",
        "Da un sistema di assi a un altro porta F·M·F⁻¹; dentro un sistema M resta com’è.",
    ),
    MistakeId.AXES_HALF_CONJUGATED: (
        "Hai cambiato gli assi da una sola parte di M.",
        "O entrambe le parti sono dette nei nuovi assi, F·M·F⁻¹, o nessuna: M da sola.",
    ),
    MistakeId.UP_AXIS: (
        "Hai scambiato y e z, come tra un sistema con y in alto e uno con z in alto.",
        "Da z in alto a y in alto è (x, z, −y), con il segno, e da entrambe le parti di una "
        "matrice.",
    ),
    MistakeId.NORMAL_ROTATION_ONLY: (
        "Hai usato solo la rotazione: scala e taglio sono rimasti fuori.",
        "Le normali vogliono anche quelli, la scala con il suo reciproco: A⁻ᵀ = R·S⁻¹ per A = R·S.",
    ),
    MistakeId.NORMAL_TRANSLATED: (
        "Hai sommato la traslazione alla normale.",
        "Una normale è una direzione, e una traslazione non muove direzioni: prendi solo A⁻ᵀn.",
    ),
    MistakeId.LIGHT_TOWARDS: (
        "Hai dato la direzione verso la lampada.",
        "La direzione di una luce è quella in cui viaggia; la l delle formule di illuminazione "
        "punta alla lampada, al contrario.",
    ),
    MistakeId.W_NOT_DIVIDED: (
        "Non hai diviso per w.",
        "Le coordinate normalizzate del dispositivo sono x, y e z di clip divise per w di clip.",
    ),
    MistakeId.WINDOW_Y: (
        "Hai contato y dall’altro lato della finestra.",
        "In OpenGL la y della finestra conta dal basso; in Direct3D, Metal, Vulkan e WebGPU "
        "dall’alto.",
    ),
}

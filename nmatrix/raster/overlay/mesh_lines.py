def creases(p, t):
    return []


def silhouette_edges(p, t, e):
    return []


def visible_pieces(w, d):
    return [w]

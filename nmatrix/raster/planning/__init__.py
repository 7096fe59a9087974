"""Planning: the effects that a scene calls for, and the proof that the others cannot be seen.

Each effect is one record (`recipe`, `effects`). Judges decide on the facts of one body (`facts`,
`seen_body`, `judges_by_geometry`, `culled_lights`, `shadow_casting`), a budget of half a level pays
for what is left out with a bound (`plan`), and the same records write the plan as GLSL (`glsl`).
"""

// The one sentence: what was done to the shape, what that does to tangents and normals, and what
// the mistake makes of it. Every clause follows from the map's numbers, never from a preset's name.
const formula = (kind, text) => `<b class="${kind}">${text}</b>`;
const figure = (x, digits = 5) => (Object.is(x, -0) ? 0 : x).toPrecision(digits).replace(/(\.\d*?)0+(e|$)/, "$1$2").replace(/\.(e|$)/, "$1").replace(/-/g, "−");
// An exact value in a few digits, also where no float is as large or as small.
function figureOf(x, digits = 5) {
  const near = x.nearest;
  if (x.isZero || (Number.isFinite(near) && near !== 0)) return figure(near, digits);
  let ten = Math.floor((bitsOf(x.top < 0n ? -x.top : x.top) - bitsOf(x.bottom)) * Math.log10(2));
  const over = (power) => (power < 0 ? x.times(new Fraction(10n ** BigInt(-power))) : x.over(new Fraction(10n ** BigInt(power)))).nearest;
  const shown = () => Math.abs(Number(over(ten).toPrecision(digits)));
  while (shown() >= 10) ten += 1;
  while (shown() < 1) ten -= 1;
  return `${figure(over(ten), digits)}e${ten < 0 ? "−" : "+"}${Math.abs(ten)}`;
}
function degreesText(x) {
  if (x === 0) return "0°";
  if (x < 0.05) return `${figure(x, 2)}°`;
  const short = x.toFixed(1);
  if ((x < 90 && Number(short) >= 90) || (x < 180 && Number(short) >= 180)) return `just under ${Number(short).toFixed(0)}°`;
  return `${short.replace(/\.0$/, "")}°`;
}
const joined = (parts) => (parts.length < 2 ? parts.join("") : `${parts.slice(0, -1).join(", ")} and ${parts[parts.length - 1]}`);
const capital = (text) => text[0].toUpperCase() + text.slice(1);

function turnedWords(s) {
  const angles = ["rx", "ry", "rz"].filter((key) => s[key] % 360 !== 0);
  return angles.length ? [`turned ${joined(angles.map((key) => `${figure(s[key])}° about <b>${key[1]}</b>`))}`] : [];
}
function shearWords(s) {
  const slides = [["hxy", "x", "y"], ["hxz", "x", "z"], ["hyz", "y", "z"]].filter(([key]) => s[key] !== 0);
  return slides.length ? [`sheared: ${joined(slides.map(([key, moved, by]) => `<b>${moved}</b> slides ${figure(s[key])} for each unit of <b>${by}</b>`))}`] : [];
}
function scaleWords(scale) {
  const sizes = scale.map(Math.abs), named = (test) => joined(AXES.filter((_, i) => test(scale[i])).map((axis) => `<b>${axis}</b>`));
  const words = [], mirrored = named((x) => x < 0), flat = named((x) => x === 0);
  if (sizes.every((x) => x === sizes[0]) && sizes[0] !== 0) {
    if (sizes[0] !== 1) words.push(`scaled ${figure(sizes[0])}× in every direction`);
  } else {
    for (const [verb, test] of [["stretched", (x) => x > 1], ["squeezed", (x) => x < 1 && x > 0]]) {
      const axes = AXES.map((axis, i) => [axis, sizes[i]]).filter(([, x]) => test(x));
      if (axes.length) words.push(`${verb} ${joined(axes.map(([axis, x]) => `${verb === "squeezed" ? "to " : ""}${figure(x)}× along <b>${axis}</b>`))}`);
    }
  }
  if (mirrored) words.push(`mirrored along ${mirrored}`);
  if (flat) words.push(`flattened along ${flat}`);
  return words.length ? [joined(words)] : [];
}
function movedWords(s) {
  const ways = AXES.filter((axis) => s[`t${axis}`] !== 0);
  return ways.length ? [`moved ${joined(ways.map((axis) => `${figure(s[`t${axis}`])} along <b>${axis}</b>`))}`] : [];
}
function doneWords(s, found) {
  const words = [...shearWords(s), ...scaleWords(found.scale), ...turnedWords(s), ...movedWords(s)];
  return words.length ? capital(words.join(", then ")) : "Left as it is";
}
// What one stretched axis asks of a normal, where that is all that was done.
function oppositeOf(s, found) {
  const sizes = found.scale.map(Math.abs), changed = sizes.filter((x) => x !== 1), isPlain = ["hxy", "hxz", "hyz"].every((key) => s[key] === 0);
  return isPlain && changed.length === 1 ? `, 1/${figure(changed[0])}` : "";
}
function sentence(s, found) {
  const done = doneWords(s, found), right = formula("right", `${SYMBOLS.exact} n`), C = formula("right", "C n");
  const off = found.largest === null ? "" : degreesText(found.largest);
  const wrong = formula("wrong", `${SYMBOLS[s.rule]} n`);
  if (s.rule === STUCK) return stuckSentence(done, found, off);
  if (found.rank === 0) return `${done}: nothing is left but a point, and a point has no normals.`;
  if (found.rank === 1) return `${done}: the shape became a line, and a line has no plane and so no normal of its own.`;
  if (s.space === "object" && found.isFlat) return `${done}: no inverse leads back to object space, so nothing can be shaded there. Choose another space.`;
  if (!found.S) return `${done}. The light has no direction here, so there is no light space.`;
  if (s.space === "object") return `${done}. In object space normals stay as they are, and light and eye are carried there instead: no normal matrix, so none to get wrong.`;
  if (found.isFlat) {
    const gone = `${done}: det A = 0, so the inverse is gone, and ${SYMBOLS.exact} with it. The cofactors still know the plane's normal, with two sides: ${C}.`;
    if (!found.wrong) return `${gone} ${wrong} asks for the inverse and has no answer.`;
    if (found.isSame) return `${gone} That is the rule ${formula("right", `${SYMBOLS[s.rule]} n`)} itself: it is right here.`;
    return s.rule === "none" && found.largest > 89.999999 ? `${gone} ${wrong} lies in the plane itself, 90° off.` : `${gone} ${wrong} is up to ${off} off.`;
  }
  if (found.isSame) return sameSentence(s, found, done);
  if (s.rule === "cofactor") return `${done}: ${determinantWords(s, found)} is negative. Cofactors alone forget that sign, so every ${wrong} points into the body, ${off} off.`;
  if (found.isConformal) return s.rule === "none"
    ? `${done}: lengths alone change, but ${s.space} space stretches on its own. There ${wrong} leans up to ${off}.`
    : `${done}: ${right} has the direction of A n here, yet ${wrong} turns normals another way, up to ${off} off.`;
  const ask = `the tangents go along with A, so a normal has to do the opposite${oppositeOf(s, found)}`;
  if (s.rule === "none") return `${done}: ${ask}. ${wrong} leans up to ${off} away from the true normal.`;
  const slip = { "not-transposed": "inverts and forgets to transpose", "not-inverted": "transposes and forgets to invert" }[s.rule];
  return `${done}: ${ask}. ${wrong} ${slip}, and is up to ${off} off.`;
}
// A space that mirrors has its say in the sign too.
function determinantWords(s, found) {
  const [own, det] = [whole(linear(found.S)), found.whole].map((A) => exactDeterminant(asFractions(A)));
  return own.top > 0n ? `det A = ${figureOf(det)}` : `${s.space} space mirrors, so det(S A) = ${figureOf(own.times(det))}`;
}
function sameSentence(s, found, done) {
  const both = `${formula("wrong", `${SYMBOLS[s.rule]} n`)} and ${formula("right", `${SYMBOLS.exact} n`)}`;
  const nothing = "so a test with this map proves nothing";
  if (s.rule === "cofactor") return `${done}: ${determinantWords(s, found)} is positive, so cofactors are ${SYMBOLS.exact} up to length. ${both} point the same way, ${nothing} about the sign.`;
  if (found.isConformal && s.rule === "none") {
    const mirror = found.sign < 0 ? " Only the rule that forgets the sign of det A would fail." : "";
    if (found.isRigid) return `${done}: lengths and angles stay, and ${SYMBOLS.exact} is A itself. ${both} are equal, ${nothing}.${mirror}`;
    return `${done}: ${both} differ in length alone, and normals are made unit, ${nothing}.${mirror}`;
  }
  return `${done}: with this very map ${both} point the same way, ${nothing}.`;
}
function stuckSentence(done, found, off) {
  // (A⁻ᵀ n) · (A l) = n · l: what was lit in the model stays lit.
  const kept = found.isFlat ? "" : ", so the same part of it stays lit wherever it is put";
  const carried = `${done}, and the light was carried along as if it belonged to the model${kept}`;
  if (!found.lamp && !found.light.some((x) => x)) return `${done}. The light has no direction here, so none can be carried along.`;
  if (off === "" && found.lamp) return `${carried}: from the model's origin one of the two lamps has no direction. A light of the world stays where it is.`;
  if (off === "") return `${carried}: A flattens its direction to nothing. In the world it stays where it is.`;
  if (found.isSame) return `${done}: the light that is carried along arrives where it was, so this test proves nothing.`;
  const where = data.has_direction ? `its direction is ${off} off` : found.largest === 0 ? "it is at another distance" : `it is ${off} off, seen from the model`;
  return `${carried}: ${formula("wrong", where)}. A light of the world stays where it is.`;
}

// --- The number, and the two tags -----------------------------------------------------------------
function numberWords(s, found) {
  if (s.rule === STUCK) return { title: "The light is off by", number: found.largest === null ? "—" : degreesText(found.largest) };
  return { title: "Off by, at worst", number: found.largest === null ? "—" : degreesText(found.largest) };
}
function tags(s, found) {
  const right = found.isFlat && s.space !== "object" ? "C <i>n</i>" : s.space === "object" ? "<i>n</i>" : `${SYMBOLS.exact} <i>n</i>`;
  if (s.rule === STUCK) return { wrong: "light stuck", right: "light fixed" };
  return { wrong: s.space === "object" ? "<i>n</i>" : `${SYMBOLS[s.rule]} <i>n</i>`, right };
}

/* Questions, as people type them, over the index that Sphinx writes.

Sphinx wants every word of a query on a page, and sorts little. Here a phrase of the index (what people
type, written beside each page) counts by the words that it shares with the question, a title by how
much of it was typed, a page by the words that it has; rare words weigh more than common ones. */

"use strict";

document.addEventListener("DOMContentLoaded", () => {
  if (typeof Search === "undefined") return;
  // From a file no other file may be read, so results have no summaries there.
  if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;

  const PHRASE = 80, TITLE = 90, PAGE = 50, FEWEST = 0.34, MOST = 30;
  const stemmer = new Stemmer();
  const ofSphinx = Search._performSearch;
  const pagesOf = (table, word) => (Object.hasOwn(table, word) ? [table[word]].flat() : []);
  const wordsOf = (text) =>
    new Set(
      splitQuery(text.toLowerCase())
        .filter((word) => !stopwords.has(word))
        .map((word) => stemmer.stemWord(word)),
    );

  /* How much a word tells: all of a page for a word of one page, little for one of all pages. */
  const weightOf = (word) => {
    const { terms, titleterms, docnames } = Search._index;
    const pages = new Set([...pagesOf(terms, word), ...pagesOf(titleterms, word)]);
    return Math.log(1 + docnames.length / Math.max(pages.size, 1));
  };
  const weigh = (words) => [...words].reduce((sum, word) => sum + weightOf(word), 0);

  const result = (page, anchor, score, kind) => {
    const { docnames, titles, filenames } = Search._index;
    return [docnames[page], titles[page], anchor, null, score, filenames[page], kind];
  };

  const byPhrases = (words) => {
    const asked = weigh(words);
    const found = [];
    for (const [phrase, places] of Object.entries(Search._index.indexentries)) {
      const own = wordsOf(phrase);
      const common = weigh([...words].filter((word) => own.has(word)));
      const likeness = (2 * common) / (asked + weigh(own));
      if (likeness < FEWEST) continue;
      for (const [page, , isMain] of places) {
        if (isMain) found.push(result(page, "", PHRASE * likeness, "index"));
      }
    }
    return found;
  };

  const byPages = (words) => {
    const { terms, titleterms } = Search._index;
    const sums = new Map();
    for (const word of words) {
      const weight = weightOf(word);
      for (const page of pagesOf(titleterms, word)) {
        sums.set(page, (sums.get(page) ?? 0) + weight);
      }
      for (const page of pagesOf(terms, word)) {
        sums.set(page, (sums.get(page) ?? 0) + weight / 2);
      }
    }
    const all = 1.5 * weigh(words);
    return [...sums].map(([page, sum]) => result(page, "", (PAGE * sum) / all, "text"));
  };

  /* The titles that Sphinx found: one that many pages have tells little. */
  const byTitles = (found) =>
    found
      .filter((one) => one[6] === "title")
      .map((one) => {
        const title = one[1].split(" > ").at(-1);
        const pages = Search._index.alltitles[title]?.length ?? 1;
        return one.with(4, ((one[4] / Scorer.title) * TITLE) / pages);
      });

  Search._performSearch = (query, words, ...others) => {
    const { terms, titleterms } = Search._index;
    const known = new Set(
      [...words].filter((word) => Object.hasOwn(terms, word) || Object.hasOwn(titleterms, word)),
    );
    const found = ofSphinx(query, words, ...others);
    if (!known.size) return found;
    const best = new Map();
    for (const one of [...byTitles(found), ...byPhrases(known), ...byPages(known)]) {
      const place = one[0] + one[2];
      if (!best.has(place) || best.get(place)[4] < one[4]) best.set(place, one);
    }
    // The best is the last: Sphinx shows them from the end.
    return [...best.values()].sort((one, other) => one[4] - other[4]).slice(-MOST);
  };
});

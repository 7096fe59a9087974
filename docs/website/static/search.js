/* Questions, as people type them, over the search of Sphinx.

Sphinx wants every word of a query on a page. Words that no page has are left out here, and if
still no page has all that are left, pages are sorted by the words they have: rare words weigh more,
words of a title twice. From a file nothing else may be read, so results have no summaries there. */

"use strict";

document.addEventListener("DOMContentLoaded", () => {
  if (typeof Search === "undefined") return;
  if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;

  const pagesOf = (table, word) => (Object.hasOwn(table, word) ? [table[word]].flat() : []);
  const allWords = Search._performSearch;

  const byWords = (words) => {
    const index = Search._index;
    const weights = new Map();
    for (const word of words) {
      const inTitle = new Set(pagesOf(index.titleterms, word));
      const pages = new Set([...inTitle, ...pagesOf(index.terms, word)]);
      const weight = Math.log(1 + index.docnames.length / pages.size);
      for (const page of pages) {
        weights.set(page, (weights.get(page) ?? 0) + weight * (inTitle.has(page) ? 2 : 1));
      }
    }
    return [...weights]
      .sort((one, other) => one[1] - other[1]) // the best is the last, as Sphinx has it
      .slice(-20)
      .map(([page, weight]) => [
        index.docnames[page], index.titles[page], "", null, weight, index.filenames[page], "text",
      ]);
  };

  Search._performSearch = (query, words, excluded, highlighted, objects) => {
    const { terms, titleterms } = Search._index;
    const known = new Set(
      [...words].filter((word) => Object.hasOwn(terms, word) || Object.hasOwn(titleterms, word)),
    );
    const found = allWords(query, known.size ? known : words, excluded, highlighted, objects);
    const pages = new Set(found.map((one) => one[0]));
    return [...byWords(known).filter((one) => !pages.has(one[0])), ...found];
  };
});

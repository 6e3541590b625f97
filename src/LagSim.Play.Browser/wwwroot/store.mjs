// What is kept for the next time, in the browser's storage. Where a person has forbidden that, it is kept as long as the page is open.

/** For all tabs, for good. */
export const store = kept(() => localStorage)

/** For this tab alone, until it is closed. */
export const tab = kept(() => sessionStorage)

function kept(storage) {
  const here = new Map()
  const attempt = (use, otherwise) => {
    try {
      return use(storage())
    } catch {
      return otherwise // it is in the page alone
    }
  }
  return {
    read: key => attempt(all => all.getItem(key), null) ?? here.get(key) ?? '',
    keys: () => [...new Set([...here.keys(), ...attempt(all => Object.keys(all), [])])],
    write(key, text) {
      here.set(key, text)
      attempt(all => all.setItem(key, text))
    },
    remove(key) {
      here.delete(key)
      attempt(all => all.removeItem(key))
    },
  }
}

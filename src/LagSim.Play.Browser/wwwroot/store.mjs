// What is kept for the next time, in the browser's storage. Where a person has forbidden that, it is kept as long as the page is open.

const here = new Map()

export const store = {
  read(key) {
    try {
      return localStorage.getItem(key) ?? here.get(key) ?? ''
    } catch {
      return here.get(key) ?? ''
    }
  },

  write(key, text) {
    here.set(key, text)
    try {
      localStorage.setItem(key, text)
    } catch {
      // It is in the page alone.
    }
  },

  keys() {
    try {
      return [...new Set([...here.keys(), ...Object.keys(localStorage)])]
    } catch {
      return [...here.keys()]
    }
  },

  remove(key) {
    here.delete(key)
    try {
      localStorage.removeItem(key)
    } catch {
      // It never was there.
    }
  },
}

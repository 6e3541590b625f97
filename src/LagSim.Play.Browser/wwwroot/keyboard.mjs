// Two people on one keyboard: W A S D move the first player, the arrows the second, wherever the focus is, and the page does not scroll.

const Ways = [
  { KeyA: [-1, 0], KeyD: [1, 0], KeyW: [0, 1], KeyS: [0, -1] }, // by place on the keyboard, whatever is written there
  { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] },
]

/** The keys that are down, as the way that each of two players goes. */
export class SharedKeyboard {
  /** @param onWay called with a player and its way, each part -1, 0 or 1, whenever it changes */
  constructor(onWay) {
    this.onWay = onWay
    this.down = new Set()
    this.isOn = false
    this.cameByTab = false // who goes through the controls by Tab needs the arrows there
    addEventListener('keydown', event => this.press(event), true)
    addEventListener('keyup', event => this.lift(event.code), true)
    addEventListener('pointerdown', () => { this.cameByTab = false }, true)
    addEventListener('blur', () => this.clear())
    document.addEventListener('visibilitychange', () => document.hidden && this.clear())
  }

  /** From now on keys count, or no more. */
  turn(isOn) {
    this.clear()
    this.isOn = isOn
  }

  press(event) {
    this.cameByTab ||= event.key === 'Tab'
    if (!this.isOn || event.ctrlKey || event.metaKey || event.altKey || !Ways.some(keys => event.code in keys) || this.isInControl()) {
      return
    }
    event.preventDefault()
    event.stopPropagation()
    if (!this.down.has(event.code)) {
      this.down.add(event.code)
      this.tell(event.code)
    }
  }

  /** Whether a control has the key: one that was reached by Tab, or a list that is open. */
  isInControl() {
    const at = document.activeElement
    return at.matches('input, select, textarea') && (this.cameByTab || (at.tagName === 'SELECT' && isOpen(at)))
  }

  lift(code) {
    if (this.down.delete(code)) {
      this.tell(code)
    }
  }

  clear() {
    for (const code of [...this.down]) {
      this.lift(code)
    }
  }

  tell(code) {
    const player = Ways.findIndex(keys => code in keys)
    const ways = Object.entries(Ways[player]).filter(([key]) => this.down.has(key)).map(([, way]) => way)
    this.onWay(player, ways.reduce((sum, way) => sum + way[0], 0), ways.reduce((sum, way) => sum + way[1], 0))
  }
}

function isOpen(select) {
  try {
    return select.matches(':open')
  } catch {
    return false // a browser that does not know it
  }
}

// Numbers as a person reads them.

/** A length that is drawn, in mm or m; what cannot be seen is 0. */
export function length(metres) {
  return Number.isNaN(metres) ? '–' : metres < 1e-6 ? '0 mm' : metres < 0.01 ? `${(metres * 1000).toFixed(1)} mm`
    : metres < 1 ? `${(metres * 1000).toFixed(0)} mm` : `${metres.toFixed(2)} m`
}

/** A length that was measured: 0 only if it is exactly that. */
export function measured(metres) {
  return metres === 0 ? '0' : Math.abs(metres) < 1e-5 ? `${metres.toExponential(2)} m` : Math.abs(metres) < 1 ? `${short(metres * 1000)} mm` : `${short(metres)} m`
}

/** Four significant digits, without zeros at the end. */
export function short(number) {
  return String(Number(number.toPrecision(4)))
}

/** A figure that was set: as it is, to six digits. */
export function figure(number) {
  return String(Number(number.toPrecision(6)))
}

/** Sets a text only if it is another one. */
export function set(element, text) {
  if (element.textContent !== text) {
    element.textContent = text
  }
}

/** Makes an element with attributes and children. */
export function make(name, attributes = {}, ...children) {
  const element = document.createElement(name)
  for (const [key, value] of Object.entries(attributes)) {
    element.setAttribute(key, value)
  }
  element.append(...children)
  return element
}

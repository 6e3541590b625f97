// What every pane draws about a body beside the body itself, whatever the game.

/** The ring around a body whose path was just rewritten. It fades with the glow, unless the person wants no motion. */
export function drawGlow(context, { x, y, radius }, glow, thin, colours, isCalm) {
  if (glow > 0) {
    context.beginPath()
    context.arc(x, y, radius + 2.5 * thin, 0, 2 * Math.PI)
    context.strokeStyle = colours.glow
    context.globalAlpha = isCalm ? 1 : glow
    context.lineWidth = 2 * thin
    context.stroke()
    context.globalAlpha = 1
  }
}

/** The dashed circle where a body is in the world without delay, if that is elsewhere. */
export function drawTruth(context, { x, y, radius }, realX, realY, thin, colours) {
  if (Math.hypot(realX - x, realY - y) > thin) {
    context.beginPath()
    context.setLineDash([3 * thin, 2 * thin])
    context.arc(realX, realY, radius, 0, 2 * Math.PI)
    context.strokeStyle = colours.real
    context.lineWidth = thin
    context.stroke()
    context.setLineDash([])
  }
}

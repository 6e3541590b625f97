namespace LagSim.Play;

/// <summary>A part of a link to the page that cannot be, and is left out.</summary>
/// <param name="Sentence">What is wrong, and what is allowed.</param>
/// <param name="Instead">What is shown instead.</param>
internal readonly record struct WrongPart(string Sentence, string Instead);

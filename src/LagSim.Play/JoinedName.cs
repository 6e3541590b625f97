using System;
using System.Globalization;
using LagSim.Net.Protection;

namespace LagSim.Play;

/// <summary>What a person at a page may be called in a session.</summary>
internal static class JoinedName
{
    /// <summary>The most characters, as a person counts them: so much has room beside a score on a phone. A session has a limit of its
    /// own, in bytes, which a name in another script may reach before.</summary>
    internal const int MaxCharacters = 24;

    /// <summary>Returns why a name cannot be, as a sentence; null if it can. None at all can be.</summary>
    internal static string? WhyNot(string name)
    {
        int characters = new StringInfo(name).LengthInTextElements;
        return characters > MaxCharacters
            ? FormattableString.Invariant($"A name has at most {MaxCharacters} characters; this one has {characters}.")
            : PlayerName.WhyNone(name) is string wrong ? $"This name cannot be: {wrong}" : null;
    }
}

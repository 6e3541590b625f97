namespace LagSim.Net.Protection;

/// <summary>The rule for what a connect key may be: text, of which no two that differ are the same bytes.</summary>
internal static class ConnectKeyText
{
    /// <summary>
    /// Returns what is wrong with a key, as the rest of a sentence; null if nothing is. A decoder that is not strict makes U+FFFD of each byte
    /// that it cannot read, and an encoder of half a surrogate pair: keys of random bytes would all be the same.
    /// </summary>
    internal static string? WhyNone(string key)
    {
        for (int at = 0; at < key.Length; at += char.IsSurrogatePair(key, at) ? 2 : 1)
        {
            if (key[at] == PlayerName.Replacement)
            {
                return "holds U+FFFD, which stands in place of bytes that are not valid UTF-8.";
            }

            if (char.IsSurrogate(key[at]) && !char.IsSurrogatePair(key, at))
            {
                return "holds half a surrogate pair, which is no character.";
            }
        }

        return null;
    }
}

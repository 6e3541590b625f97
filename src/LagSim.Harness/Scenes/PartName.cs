namespace LagSim.Harness.Scenes;

/// <summary>What a scene file accepts as a name, checked before a name gets into a message, a table or a terminal.</summary>
internal static class PartName
{
    internal const int MaxLength = 64;

    /// <summary>What is wrong with a name, or null.</summary>
    internal static string? Problem(string name)
    {
        if (name.Length is 0 or > MaxLength)
        {
            return $"the name has {name.Length} characters; a name has 1 to {MaxLength}";
        }

        for (int i = 0; i < name.Length; i++)
        {
            if (char.IsControl(name[i]))
            {
                return $"the name has the control character U+{(int)name[i]:X4}; a name has none";
            }

            if (char.IsHighSurrogate(name[i]) && i + 1 < name.Length && char.IsLowSurrogate(name[i + 1]))
            {
                i++;
            }
            else if (char.IsSurrogate(name[i]))
            {
                return "the name has half of a surrogate pair, which is no text";
            }
        }

        return null;
    }
}

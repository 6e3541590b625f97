using System;
using System.Collections.Generic;
using System.Text;

namespace LagSim.Scenes;

/// <summary>The names that a scene, or a part of one, may have: checked before a name gets into a table, a file or a terminal.</summary>
internal static class PartName
{
    internal const int MaxLength = 64;

    /// <summary>The error in a name, or null.</summary>
    internal static string? Problem(string? name)
    {
        if (name is null || name.Length is 0 or > MaxLength)
        {
            return $"the name has {name?.Length ?? 0} characters; a name has 1 to {MaxLength}";
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

    /// <summary>A name that may be none, on one line, with U+FFFD for what is no text, and not too long.</summary>
    internal static string Shown(string? name)
    {
        StringBuilder shown = new();
        for (int i = 0; name is not null && i < name.Length && i < MaxLength; i++)
        {
            bool isPair = i + 1 < name.Length && char.IsSurrogatePair(name[i], name[i + 1]);
            shown.Append(char.IsControl(name[i]) || (char.IsSurrogate(name[i]) && !isPair) ? '\uFFFD' : name[i]);
            if (isPair)
            {
                shown.Append(name[++i]);
            }
        }

        return name?.Length > MaxLength ? shown.Append("...").ToString() : shown.ToString();
    }

    /// <summary>Checks the names of all parts of a scene.</summary>
    /// <exception cref="SceneException">One is no name, or stands twice.</exception>
    internal static void CheckAll(string scene, List<string> names)
    {
        names.Sort(StringComparer.Ordinal);
        for (int i = 0; i < names.Count; i++)
        {
            if (Problem(names[i]) is string problem)
            {
                throw new SceneException($"'{Shown(names[i])}' is no name for a part of scene '{scene}': {problem}.");
            }

            if (i > 0 && string.Equals(names[i], names[i - 1], StringComparison.Ordinal))
            {
                throw new SceneException($"Two parts of scene '{scene}' are named '{names[i]}'; every name must be unique.");
            }
        }
    }
}

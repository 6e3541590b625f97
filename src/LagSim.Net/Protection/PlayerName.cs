using System;
using System.Text;

namespace LagSim.Net.Protection;

/// <summary>The rule for what a peer may call itself: a name shows all that is in it, and reads as nothing else that a roster says.</summary>
/// <remarks>
/// The characters stand here as ranges, and are not asked of the platform: runtimes know different versions of Unicode, and a name that one
/// peer sends must be one for all.
/// </remarks>
internal static class PlayerName
{
    /// <summary>The longest name, in bytes of UTF-8.</summary>
    internal const int MaxBytes = Events.PlayerEvent.MaxNameBytes;

    /// <summary>
    /// Blanks other than the space, separators of lines and paragraphs, what changes the direction of text, and all else that shows nothing:
    /// the categories Zs, Zl, Zp and Cf, what a font may leave out, and fillers.
    /// </summary>
    internal static readonly int[] Unseen =
    {
        0x00A0, 0x00A0, 0x00AD, 0x00AD, 0x034F, 0x034F, 0x0600, 0x0605, 0x061C, 0x061C, 0x06DD, 0x06DD, 0x070F, 0x070F, 0x0890, 0x0891,
        0x08E2, 0x08E2, 0x115F, 0x1160, 0x1680, 0x1680, 0x17B4, 0x17B5, 0x180E, 0x180E, 0x2000, 0x200F, 0x2028, 0x202F, 0x205F, 0x206F,
        0x2800, 0x2800, 0x3000, 0x3000, 0x3164, 0x3164, 0xFEFF, 0xFEFF, 0xFFA0, 0xFFA0, 0xFFF0, 0xFFFB, 0x110BD, 0x110BD, 0x110CD, 0x110CD,
        0x13430, 0x1343F, 0x1BCA0, 0x1BCA3, 0x1D159, 0x1D159, 0x1D173, 0x1D17A, 0xE0000, 0xE00FF, 0xE01F0, 0xE0FFF,
    };

    /// <summary>Variation selectors: they choose the form of the character before them, and show nothing without one.</summary>
    internal static readonly int[] Selectors = { 0x180B, 0x180D, 0x180F, 0x180F, 0xFE00, 0xFE0F, 0xE0100, 0xE01EF };

    /// <summary>Marks that stand over or under the character before them: a digit with one is a digit.</summary>
    internal static readonly int[] Accents = { 0x0300, 0x036F, 0xFE20, 0xFE2F };

    /// <summary>Decimal digits of all scripts, and numbers that are one character: raised, lowered, circled, Roman, fractions.</summary>
    internal static readonly int[] Digits =
    {
        0x0030, 0x0039, 0x00B2, 0x00B3, 0x00B9, 0x00B9, 0x00BC, 0x00BE, 0x0660, 0x0669, 0x06F0, 0x06F9, 0x07C0, 0x07C9, 0x0966, 0x096F,
        0x09E6, 0x09EF, 0x0A66, 0x0A6F, 0x0AE6, 0x0AEF, 0x0B66, 0x0B6F, 0x0BE6, 0x0BEF, 0x0C66, 0x0C6F, 0x0CE6, 0x0CEF, 0x0D66, 0x0D6F,
        0x0DE6, 0x0DEF, 0x0E50, 0x0E59, 0x0ED0, 0x0ED9, 0x0F20, 0x0F29, 0x1040, 0x1049, 0x1090, 0x1099, 0x17E0, 0x17E9, 0x1810, 0x1819,
        0x1946, 0x194F, 0x19D0, 0x19DA, 0x1A80, 0x1A89, 0x1A90, 0x1A99, 0x1B50, 0x1B59, 0x1BB0, 0x1BB9, 0x1C40, 0x1C49, 0x1C50, 0x1C59,
        0x2070, 0x2070, 0x2074, 0x2079, 0x2080, 0x2089, 0x2150, 0x2182, 0x2185, 0x2189, 0x2460, 0x249B, 0x24EA, 0x24FF, 0x2776, 0x2793,
        0x3220, 0x3229, 0x3248, 0x324F, 0x3251, 0x325F, 0x3280, 0x3289, 0x32B1, 0x32BF, 0xA620, 0xA629, 0xA8D0, 0xA8D9, 0xA900, 0xA909,
        0xA9D0, 0xA9D9, 0xA9F0, 0xA9F9, 0xAA50, 0xAA59, 0xABF0, 0xABF9, 0xFF10, 0xFF19, 0x104A0, 0x104A9, 0x10D30, 0x10D39, 0x10D40, 0x10D49,
        0x11066, 0x1106F, 0x110F0, 0x110F9, 0x11136, 0x1113F, 0x111D0, 0x111D9, 0x112F0, 0x112F9, 0x11450, 0x11459, 0x114D0, 0x114D9,
        0x11650, 0x11659, 0x116C0, 0x116C9, 0x116D0, 0x116E3, 0x11730, 0x11739, 0x118E0, 0x118E9, 0x11950, 0x11959, 0x11BF0, 0x11BF9,
        0x11C50, 0x11C59, 0x11D50, 0x11D59, 0x11DA0, 0x11DA9, 0x11DE0, 0x11DE9, 0x11F50, 0x11F59, 0x16130, 0x16139, 0x16A60, 0x16A69,
        0x16AC0, 0x16AC9, 0x16B50, 0x16B59, 0x16D70, 0x16D79, 0x1CCF0, 0x1CCF9, 0x1D7CE, 0x1D7FF, 0x1E140, 0x1E149, 0x1E2F0, 0x1E2F9,
        0x1E4F0, 0x1E4F9, 0x1E5F1, 0x1E5FA, 0x1E950, 0x1E959, 0x1F100, 0x1F10C, 0x1FBF0, 0x1FBF9,
    };

    /// <summary>Punctuation and symbols, which part words; not the hyphen and the underscore, which join them.</summary>
    internal static readonly int[] Parting =
    {
        0x0020, 0x002C, 0x002E, 0x002F, 0x003A, 0x0040, 0x005B, 0x005E, 0x0060, 0x0060, 0x007B, 0x007E, 0x00A1, 0x00A9, 0x00AB, 0x00AC,
        0x00AE, 0x00B1, 0x00B4, 0x00B4, 0x00B6, 0x00B8, 0x00BB, 0x00BB, 0x00BF, 0x00BF, 0x00D7, 0x00D7, 0x00F7, 0x00F7, 0x055A, 0x055F,
        0x060C, 0x060D, 0x061B, 0x061F, 0x066A, 0x066D, 0x06D4, 0x06D4, 0x0964, 0x0965, 0x1361, 0x1368, 0x2010, 0x206F, 0x20A0, 0x20FF,
        0x2190, 0x2BFF, 0x2E00, 0x2E7F, 0x3001, 0x3004, 0x3008, 0x3020, 0x3030, 0x3030, 0xFE10, 0xFE1F, 0xFE30, 0xFE6F, 0xFF01, 0xFF0F,
        0xFF1A, 0xFF20, 0xFF3B, 0xFF40, 0xFF5B, 0xFF65, 0xFFE0, 0xFFEE, 0x1F000, 0x1FAFF,
    };

    /// <summary>Returns what is wrong with a name, as a sentence; null if nothing is.</summary>
    internal static string? WhyNone(string name)
    {
        int before = ' ';
        for (int at = 0; at < name.Length; at += Length(name, at))
        {
            if (char.IsSurrogate(name[at]) && !char.IsSurrogatePair(name, at))
            {
                return "it holds half a surrogate pair, which is no character.";
            }

            int one = char.ConvertToUtf32(name, at);
            if (one is < ' ' or (>= 0x7F and < 0xA0))
            {
                return FormattableString.Invariant($"it holds the control character U+{one:X4}, which could change what a terminal shows.");
            }

            if (IsIn(Unseen, one) || (IsIn(Selectors, one) && (before == ' ' || IsIn(Selectors, before))))
            {
                return FormattableString.Invariant($"it holds U+{one:X4}, which nobody sees, or sees only by what it does to the text around it;")
                    + " of all blanks a name may have the plain space.";
            }

            before = one;
        }

        if (name.Length > 0 && string.IsNullOrWhiteSpace(name))
        {
            return "it is blanks alone; none at all is the empty name.";
        }

        if (LoneNumber(name) is string number)
        {
            return $"it holds the number '{number}' by itself, which reads as a player's number; joined to a word it may stay, as in 'Ann2' or 'Ann-2'.";
        }

        int bytes = Encoding.UTF8.GetByteCount(name);
        return bytes <= MaxBytes
            ? null : $"'{name}' has {bytes} bytes of UTF-8; at most {MaxBytes} are allowed.";
    }

    /// <summary>The first number that is joined to no word; null for none.</summary>
    private static string? LoneNumber(string name)
    {
        bool isJoined = false; // to what stands before it
        for (int at = 0; at < name.Length;)
        {
            int end = at;
            while (end < name.Length && (IsDigit(name, end) || (end > at && IsMark(name, end))))
            {
                end += Length(name, end);
            }

            if (end > at && !isJoined && (end == name.Length || IsIn(Parting, char.ConvertToUtf32(name, end))))
            {
                return name.Substring(at, end - at);
            }

            at = end;
            if (at < name.Length)
            {
                isJoined = !IsIn(Parting, char.ConvertToUtf32(name, at)) && (isJoined || !IsMark(name, at));
                at += Length(name, at);
            }
        }

        return null;
    }

    private static int Length(string name, int at) => char.IsSurrogatePair(name, at) ? 2 : 1;

    private static bool IsDigit(string name, int at) => IsIn(Digits, char.ConvertToUtf32(name, at));

    private static bool IsMark(string name, int at)
    {
        int one = char.ConvertToUtf32(name, at);
        return IsIn(Accents, one) || IsIn(Selectors, one);
    }

    /// <summary>Whether a character is in one of the ranges, which ascend.</summary>
    private static bool IsIn(int[] ranges, int character)
    {
        int low = 0, high = ranges.Length / 2;
        while (low < high)
        {
            int middle = (low + high) / 2;
            if (ranges[(2 * middle) + 1] < character)
            {
                low = middle + 1;
            }
            else
            {
                high = middle;
            }
        }

        return low < ranges.Length / 2 && ranges[2 * low] <= character;
    }
}

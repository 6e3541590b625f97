using System;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// Tracks which of the newest numbered datagrams have arrived, so that each counts once, despite duplicates and reordering.
/// </summary>
internal sealed class SeenNumbers
{
    /// <summary>The distance behind the newest at which a number counts as seen.</summary>
    internal const int Span = 1024;

    private const int WordBits = 64;

    private readonly ulong[] seen = new ulong[Span / WordBits];

    /// <summary>The highest number that has arrived; 0 before there is one.</summary>
    internal ulong Newest { get; private set; }

    /// <summary>Whether a number, 1 or more, has not arrived before and is not too old to know.</summary>
    internal bool IsNew(ulong number) =>
        number > Newest || (number > 0 && Newest - number < Span && (seen[Word(number)] & Bit(number)) == 0);

    /// <summary>Records a number, 1 or more; false if it has arrived before, or is too old to know.</summary>
    internal bool Add(ulong number)
    {
        if (number > Newest)
        {
            if (number - Newest >= Span)
            {
                Array.Clear(seen, 0, seen.Length);
            }
            else
            {
                for (ulong n = Newest + 1; n < number; n++)
                {
                    seen[Word(n)] &= ~Bit(n);
                }
            }

            Newest = number;
            seen[Word(number)] |= Bit(number);
            return true;
        }

        if (!IsNew(number))
        {
            return false;
        }

        seen[Word(number)] |= Bit(number);
        return true;
    }

    /// <summary>Which of the 32 numbers before one that is not above <see cref="Newest"/> have arrived: bit n for number - 1 - n.</summary>
    internal uint BitsBefore(ulong number)
    {
        uint bits = 0;
        for (uint n = 1; n <= 32 && n < number; n++)
        {
            bits |= (seen[Word(number - n)] & Bit(number - n)) != 0 ? 1u << (int)(n - 1) : 0;
        }

        return bits;
    }

    private static int Word(ulong number) => (int)(number % Span / WordBits);

    private static ulong Bit(ulong number) => 1UL << (int)(number % WordBits);
}

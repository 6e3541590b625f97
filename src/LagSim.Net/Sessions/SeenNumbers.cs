using System;

namespace LagSim.Net.Sessions;

/// <summary>Which of the newest numbered datagrams have come, so that each counts once, however often it comes and whatever overtook it.</summary>
internal sealed class SeenNumbers
{
    /// <summary>What is so much older than the newest counts as seen.</summary>
    internal const int Span = 1024;

    private const int WordBits = 64;

    private readonly ulong[] seen = new ulong[Span / WordBits];

    /// <summary>The highest number that has come; 0 before there is one.</summary>
    internal uint Newest { get; private set; }

    /// <summary>Notes a number, 1 or more; false if it has come before, or is so old that nobody knows.</summary>
    internal bool Add(uint number)
    {
        if (number > Newest)
        {
            if (number - Newest >= Span)
            {
                Array.Clear(seen, 0, seen.Length);
            }
            else
            {
                for (uint n = Newest + 1; n < number; n++)
                {
                    seen[Word(n)] &= ~Bit(n);
                }
            }

            Newest = number;
            seen[Word(number)] |= Bit(number);
            return true;
        }

        if (number == 0 || Newest - number >= Span || (seen[Word(number)] & Bit(number)) != 0)
        {
            return false;
        }

        seen[Word(number)] |= Bit(number);
        return true;
    }

    private static int Word(uint number) => (int)(number % Span / WordBits);

    private static ulong Bit(uint number) => 1UL << (int)(number % WordBits);
}

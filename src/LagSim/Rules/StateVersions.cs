using System;
using System.Collections.Generic;

namespace LagSim.Rules;

/// <summary>
/// Lends versions of the state, and their pages, and takes back those that nobody keeps any more, so that no memory is asked for after a
/// while.
/// </summary>
/// <remarks>
/// A version has the pages of the one before it up to the first byte that differs, and after the last, wherever these have moved to: a
/// timer that is set, or a body that gets a state, moves all that is behind it. Cost of one more: its bytes compared, and what changed
/// copied.
/// </remarks>
internal sealed class StateVersions
{
    /// <summary>What a reference to a page counts, on any machine.</summary>
    private const int ReferenceBytes = 8;

    /// <summary>The room of the smallest page, for the state of rules that have next to none: its head and no timer take that.</summary>
    private const int LeastRoom = StateLayout.HeadBytes;

    private readonly Stack<StateVersion> free = new();
    private readonly Stack<StatePage>[] freePages = new Stack<StatePage>[7]; // by room: 16 bytes, and twice that up to the most
    private byte[] whole = Array.Empty<byte>(); // the bytes of the version that was asked for last
    private long wholeSerial;
    private long lastSerial;

    /// <summary>How many bytes the versions take that somebody keeps.</summary>
    internal long Bytes { get; private set; }

    /// <summary>A version of this state, kept once, with the pages that it shares with another; null if there is none.</summary>
    internal StateVersion Add(ReadOnlySpan<byte> state, StateVersion? like)
    {
        int known = like?.PageCount ?? 0;
        int first = 0; // that many pages are shared from the front, to here
        int from = 0;
        while (first < known && CanShare(like!.Pages[first]) && state.Slice(from).StartsWith(like.Pages[first].Bytes))
        {
            from += like.Pages[first++].Length;
        }

        int last = known; // and from that one on, from here
        int to = state.Length;
        while (last > first && CanShare(like!.Pages[last - 1]) && state.Slice(from, to - from).EndsWith(like.Pages[last - 1].Bytes))
        {
            to -= like.Pages[--last].Length;
        }

        while (from < to && to - from < StatePage.LeastBytes && (first > 0 || last < known))
        {
            if (first > 0)
            {
                from -= like!.Pages[--first].Length;
            }
            else
            {
                to += like!.Pages[last++].Length;
            }
        }

        int made = (to - from + StatePage.MostBytes - 1) / StatePage.MostBytes;
        StateVersion version = Take(state.Length, first + made + known - last);
        if (like is not null)
        {
            Array.Copy(like.Pages, 0, version.Pages, 0, first);
            Array.Copy(like.Pages, last, version.Pages, first + made, known - last);
        }

        for (int n = 0; n < made; n++)
        {
            int at = from + (int)((long)(to - from) * n / made);
            int end = from + (int)((long)(to - from) * (n + 1) / made);
            version.Pages[first + n] = Take(state.Slice(at, end - at));
        }

        for (int page = 0; page < version.PageCount; page++)
        {
            version.Pages[page].Uses++;
        }

        return version;
    }

    /// <summary>Keeps a version in place of another that was kept, or of none.</summary>
    internal void Replace(ref StateVersion? kept, StateVersion? by)
    {
        if (by is not null)
        {
            by.Uses++;
        }

        if (kept is not null && --kept.Uses == 0)
        {
            Free(kept);
        }

        kept = by;
    }

    /// <summary>All bytes of a version, one after the other.</summary>
    internal ReadOnlySpan<byte> Whole(StateVersion version)
    {
        if (wholeSerial != version.Serial)
        {
            if (whole.Length < version.Length)
            {
                whole = new byte[Math.Max(version.Length, 2 * whole.Length)];
            }

            int at = 0;
            for (int page = 0; page < version.PageCount; page++)
            {
                version.Pages[page].Bytes.CopyTo(whole.AsSpan(at));
                at += version.Pages[page].Length;
            }

            wholeSerial = version.Serial;
        }

        return whole.AsSpan(0, version.Length);
    }

    /// <summary>Whether a page is long enough to be one of several: the only one of a short state is not.</summary>
    private static bool CanShare(StatePage page) => page.Length >= StatePage.LeastBytes;

    private StateVersion Take(int length, int pages)
    {
        StateVersion version = free.Count > 0 ? free.Pop() : new StateVersion(this);
        version.Serial = ++lastSerial;
        version.Length = length;
        version.PageCount = pages;
        version.Uses = 1;
        if (version.Pages.Length < pages)
        {
            version.Pages = new StatePage[Math.Max(pages, 2 * version.Pages.Length)];
        }

        Bytes += pages * ReferenceBytes;
        return version;
    }

    /// <summary>How often the least room has to be doubled for so many bytes.</summary>
    private static int SizeOf(int bytes)
    {
        int size = 0;
        while (LeastRoom << size < bytes)
        {
            size++;
        }

        return size;
    }

    private StatePage Take(ReadOnlySpan<byte> part)
    {
        int size = SizeOf(part.Length);
        Stack<StatePage> of = freePages[size] ??= new Stack<StatePage>();
        StatePage page = of.Count > 0 ? of.Pop() : new StatePage(LeastRoom << size);
        page.Set(part);
        Bytes += page.Room;
        return page;
    }

    private void Free(StatePage page)
    {
        Bytes -= page.Room;
        freePages[SizeOf(page.Room)].Push(page);
    }

    private void Free(StateVersion version)
    {
        for (int page = 0; page < version.PageCount; page++)
        {
            if (--version.Pages[page].Uses == 0)
            {
                Free(version.Pages[page]);
            }
        }

        Bytes -= version.PageCount * ReferenceBytes;
        free.Push(version);
    }
}

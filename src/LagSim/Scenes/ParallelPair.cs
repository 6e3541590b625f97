using System;
using System.Runtime.ExceptionServices;
using System.Threading;

namespace LagSim.Scenes;

/// <summary>Does two independent things on two threads, and returns when both are done.</summary>
/// <remarks>
/// They must not depend on which thread they are on, and each writes to places of its own. Errors come as if one ran after the other: that
/// of the first, or else that of the second. Without threads, one thing is done after the other.
/// </remarks>
internal static class ParallelPair
{
    /// <summary>
    /// The number of bodies below which a thread is not worth it: they are checked in a few milliseconds, and a thread takes some tenth of
    /// one to start, or more where others are at work.
    /// </summary>
    internal const int MinBodies = 16_384;

    /// <summary>Does both at once, or one after the other if only one thread may be used.</summary>
    internal static void Do(int threads, Action first, Action second)
    {
        ExceptionDispatchInfo? failure = null;
        Thread? other = threads > 1 ? Start(Second) : null;
        try
        {
            first();
        }
        finally
        {
            other?.Join();
        }

        if (other is null)
        {
            second();
        }

        failure?.Throw();

        void Second()
        {
            try
            {
                second();
            }
            catch (Exception exception)
            {
                failure = ExceptionDispatchInfo.Capture(exception);
            }
        }
    }

    /// <summary>
    /// Goes through a range in as many parts as threads may be used, or fewer if they would be small; in order within each. The error is
    /// that of the foremost part.
    /// </summary>
    internal static void InParts(int from, int to, int threads, Action<int, int> part)
    {
        if (threads <= 1 || to - from < MinBodies)
        {
            part(from, to);
            return;
        }

        int middle = from + ((to - from) / 2);
        Do(threads, () => InParts(from, middle, threads - (threads / 2), part), () => InParts(middle, to, threads / 2, part));
    }

    /// <summary>A thread that does this; none where the platform has no threads.</summary>
    private static Thread? Start(ThreadStart what)
    {
        try
        {
            Thread thread = new(what) { IsBackground = true, Name = "LagSim scene" };
            thread.Start();
            return thread;
        }
        catch (NotSupportedException)
        {
            return null;
        }
    }
}

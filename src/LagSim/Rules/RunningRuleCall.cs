using System.Threading;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Rules;

/// <summary>The call of rules that a world is in, if it is in one: published by the thread that makes it, and looked at by a
/// watchdog.</summary>
/// <remarks>
/// <para>Nothing here asks a clock, and no bit of a world depends on it: a call that is given up ends the world on this peer, and never
/// goes on with another result.</para>
/// <para>The world's thread begins and ends calls. Any other may ask which call runs, and give that one up: then whatever the call asks of
/// the world throws, and so does its end. No thread can be made to leave code that never asks. Such a thread is abandoned: should it come
/// back after all, it sleeps for ever, so that it can touch nothing that others have taken over.</para>
/// </remarks>
/// <param name="limit">How long a call may take. It is only said in the sentence: the watchdog that looks keeps the time.</param>
internal sealed class RunningRuleCall(SimDuration limit)
{
    private const long GivenUp = -1; // in a call that is given up
    private const long Left = -2; // the thread has left that call
    private const long Abandoned = -3; // the thread has not, and may not come back

    private long state; // grows by one at each beginning and each end, so it is odd in a call; or one of the above
    private Scene? scene;
    private string what = "";
    private EventKey key;
    private RuleTrigger trigger;

    /// <summary>How long a call may take.</summary>
    internal SimDuration Limit => limit;

    /// <summary>Whether a call was given up. The world is over then.</summary>
    internal bool IsGivenUp => Volatile.Read(ref state) < 0;

    /// <summary>Which call runs, as a number that no other call has; 0 if none does, or it is given up.</summary>
    internal long Number => Volatile.Read(ref state) is long now and > 0 && (now & 1) == 1 ? now : 0;

    /// <summary>A call begins. For the world's thread.</summary>
    /// <param name="of">The scene, which has the rules.</param>
    /// <param name="method">The method that is called.</param>
    /// <param name="on">The event that it is for.</param>
    /// <param name="more">More about that event.</param>
    /// <exception cref="SimulationException">A call was given up before.</exception>
    internal void Begin(Scene of, string method, in EventKey on, in RuleTrigger more)
    {
        Touch();
        scene = of;
        what = method;
        key = on;
        trigger = more;
        Volatile.Write(ref state, state + 1);
    }

    /// <summary>It has returned or thrown. For the world's thread.</summary>
    /// <exception cref="SimulationException">It was given up meanwhile.</exception>
    internal void End()
    {
        long now = Volatile.Read(ref state);
        if (now > 0 && Interlocked.CompareExchange(ref state, now + 1, now) == now)
        {
            return;
        }

        Interlocked.CompareExchange(ref state, Left, GivenUp);
        Touch();
    }

    /// <summary>The call asks something of the world. For the world's thread.</summary>
    /// <exception cref="SimulationException">It was given up.</exception>
    internal void Touch()
    {
        long now = Volatile.Read(ref state);
        if (now >= 0)
        {
            return;
        }

        if (now == Abandoned)
        {
            Thread.Sleep(Timeout.Infinite);
        }

        throw new SimulationException(Sentence());
    }

    /// <summary>Gives a call up. From any thread.</summary>
    /// <param name="number">Its <see cref="Number"/>.</param>
    /// <returns>False if it does not run any more; then nothing has changed.</returns>
    internal bool TryGiveUp(long number) => Interlocked.CompareExchange(ref state, GivenUp, number) == number;

    /// <summary>Gives up the thread too, which has not left a call that is given up. From any thread.</summary>
    /// <returns>False if it has left it, or no call is given up; then nothing has changed.</returns>
    internal bool TryAbandon() => Interlocked.CompareExchange(ref state, Abandoned, GivenUp) == GivenUp;

    /// <summary>Which call was given up, and why. For a call that is.</summary>
    internal string Sentence() =>
        RuleCallText.Failed(scene!, what, key, trigger, $"it has not returned within {limit.ToShortString()}, and was given up.");
}

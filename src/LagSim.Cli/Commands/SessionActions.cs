using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary>The scripted actions of a peer. Performs each at its time, and reports those that failed or were refused.</summary>
/// <remarks>Methods are for the printing thread. Results from the session's thread arrive through the queue.</remarks>
internal sealed class SessionActions
{
    private readonly Session session;
    private readonly IReadOnlyList<ScriptedAction> script;
    private readonly SessionPrinter printer;
    private readonly PrintQueue queue;
    private readonly Dictionary<uint, ScriptedAction> unconfirmed = []; // a client's own, by sequence number; owned by the session's thread
    private readonly List<(ScriptedAction Action, Task Attempt)> attempts = []; // outcome not yet checked
    private volatile bool isAwaitingVerdict; // whether any has no verdict yet
    private PlayerAction[]? inScene; // the resolved actions, once the scene is known
    private int done; // performed or given up

    internal SessionActions(Session session, IReadOnlyList<ScriptedAction> script, SessionPrinter printer, PrintQueue queue)
    {
        this.session = session;
        this.script = script;
        this.printer = printer;
        this.queue = queue;
        session.Logged += OnLogged;
        if (session is ClientSession client)
        {
            client.Renewed += _ => OnRenewed();
        }
    }

    /// <summary>Whether any action failed, was refused, or has no known verdict.</summary>
    internal bool HaveFailed { get; private set; }

    /// <summary>Whether the scene is known and the actions are resolved.</summary>
    internal bool HaveBegun => inScene is not null;

    /// <summary>Whether every attempted action has a known outcome.</summary>
    internal bool AreSettled => attempts.Count == 0 && !isAwaitingVerdict;

    /// <summary>The time of the next action, in seconds since the session's start; <see cref="double.MaxValue"/> after the last.</summary>
    internal double NextSeconds => done < script.Count ? script[done].Seconds : double.MaxValue;

    /// <summary>
    /// Resolves the actions in the scene, and gives up those whose time is past: performed now, they would have another effect.
    /// </summary>
    /// <exception cref="UsageException">An action names a body that the scene does not have.</exception>
    internal void Begin(Scene scene, double passed)
    {
        inScene = script.Select(action => action.ActionIn(scene, session.Peer)).ToArray();
        while (NextSeconds < passed)
        {
            done++;
        }

        if (done > 0)
        {
            Fail(FormattableString.Invariant(
                $"Not done, for the time was past when this peer came in at T {passed:0.000} s: {Texts(script.Take(done))}."));
        }
    }

    /// <summary>Performs every action that is due. Call <see cref="Begin"/> first.</summary>
    internal void DoDue(PeerThread thread, double passed)
    {
        for (; NextSeconds <= passed; done++)
        {
            Do(thread, script[done], inScene![done]);
        }
    }

    /// <summary>Reports the actions that could not be performed on this peer.</summary>
    internal void LookAtAttempts()
    {
        foreach ((ScriptedAction action, Task attempt) in attempts)
        {
            if (attempt.IsFaulted)
            {
                Fail($"--do {action.Text} was not done. {Sentence.Of(attempt.Exception!.InnerException!)}");
            }
        }

        attempts.RemoveAll(a => a.Attempt.IsFaulted || a.Attempt.IsCompletedSuccessfully);
    }

    /// <summary>Reports the actions that were not performed or have no known verdict. The session's thread must have stopped.</summary>
    internal void TellUndone()
    {
        ScriptedAction[] undone = [.. attempts.Select(a => a.Action), .. script.Skip(done)];
        if (undone.Length > 0)
        {
            Fail($"Not done, for the session ended before: {Texts(undone)}.");
        }

        if (unconfirmed.Count > 0)
        {
            Fail($"Done here, but the session ended before the host's verdict came: {Unconfirmed()}.");
        }
    }

    private void Do(PeerThread thread, ScriptedAction action, PlayerAction what) => attempts.Add((action, thread.Ask(peer =>
    {
        ExternalEvent external = peer.Do(
            what, action.At is double at ? peer.World!.Simulation.Start + SimDuration.FromSeconds(at) : null);
        if (peer is ClientSession) // a host's own actions need no verdict
        {
            unconfirmed[external.Sequence] = action;
            isAwaitingVerdict = true;
        }

        return external;
    })));

    private void OnLogged(LogEntry entry)
    {
        bool isOwn = session is ClientSession && entry.Event.Peer == session.Peer;
        if (isOwn && unconfirmed.Remove(entry.Event.Sequence, out ScriptedAction? action))
        {
            isAwaitingVerdict = unconfirmed.Count > 0;
            if (!entry.IsAccepted)
            {
                queue.Tell(() => Fail($"The host refused --do {action.Text}: {Why(entry.Verdict)}."));
            }
        }
    }

    /// <summary>
    /// Stops waiting for outstanding verdicts. After a fresh snapshot this peer's sequence numbers may start again, so a later verdict on
    /// one of them would be about another event.
    /// </summary>
    private void OnRenewed()
    {
        if (unconfirmed.Count > 0)
        {
            string texts = Unconfirmed();
            unconfirmed.Clear();
            isAwaitingVerdict = false;
            queue.Tell(() => Fail($"Done here, but a fresh copy took the place of the world before the host's verdict came: {texts}."));
        }
    }

    private void Fail(string sentence)
    {
        HaveFailed = true;
        printer.Problem(sentence);
    }

    private string Unconfirmed() => Texts(unconfirmed.OrderBy(one => one.Key).Select(one => one.Value));

    private static string Texts(IEnumerable<ScriptedAction> actions) => string.Join(", ", actions.Select(action => $"--do {action.Text}"));

    private static string Why(Verdict verdict) => verdict switch
    {
        Verdict.TooLate => "it came too late, when nothing could change any more what was to happen then (the host's --history-s and --longest-history-s)",
        Verdict.TooEarly => "it is stamped too far in the future",
        Verdict.NoRight =>
            "this peer may not do that: it has no right to, or what it did costs more than the host allows (docs/BUDGETS.md)",
        _ => "it makes no sense in this scene",
    };
}

using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;

namespace LagSim.Cli.Commands;

/// <summary>The actions that a peer of a session is to do: does each at its time, and tells which were not done or were refused.</summary>
/// <remarks>Its methods are for the printing thread. What the session's thread tells it comes by the queue.</remarks>
internal sealed class SessionActions
{
    private readonly Session session;
    private readonly IReadOnlyList<ScriptedAction> script;
    private readonly SessionPrinter printer;
    private readonly PrintQueue queue;
    private readonly Dictionary<uint, ScriptedAction> unconfirmed = []; // own ones of a client, by sequence number; the session's thread's
    private readonly List<(ScriptedAction Action, Task Attempt)> attempts = []; // of which the outcome has not been looked at
    private volatile bool isAwaitingVerdict; // whether any is unjudged
    private PlayerAction[]? inScene; // what each is, once the scene is known
    private int done; // or given up

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

    /// <summary>Whether any was not done, was refused, or is not known to have been accepted.</summary>
    internal bool HaveFailed { get; private set; }

    /// <summary>Whether the scene in which they are done is known.</summary>
    internal bool HaveBegun => inScene is not null;

    /// <summary>Whether there is nothing to be heard of those that were tried.</summary>
    internal bool AreSettled => attempts.Count == 0 && !isAwaitingVerdict;

    /// <summary>When the next is to be done, in seconds since the session's start; the largest number after the last.</summary>
    internal double NextSeconds => done < script.Count ? script[done].Seconds : double.MaxValue;

    /// <summary>Finds out what they are in the scene, and gives up those whose time is past: done now they would be others.</summary>
    /// <exception cref="UsageException">The scene has not the body of one.</exception>
    internal void Begin(Scene scene, double passed)
    {
        inScene = script.Select(action => action.ActionIn(scene)).ToArray();
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

    /// <summary>Does what is due. They must have begun.</summary>
    internal void DoDue(PeerThread thread, double passed)
    {
        for (; NextSeconds <= passed; done++)
        {
            Do(thread, script[done], inScene![done]);
        }
    }

    /// <summary>Tells of what could not be done here.</summary>
    internal void LookAtAttempts()
    {
        foreach ((ScriptedAction action, Task attempt) in attempts)
        {
            if (attempt.IsFaulted)
            {
                Fail($"--do {action.Text} was not done. {attempt.Exception!.InnerException!.Message}");
            }
        }

        attempts.RemoveAll(a => a.Attempt.IsFaulted || a.Attempt.IsCompletedSuccessfully);
    }

    /// <summary>Tells of what was not done, or what nobody knows of. The session's thread must have stopped.</summary>
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
        ExternalEvent external = peer.Do(what);
        if (peer is ClientSession) // what a host does needs nobody's leave
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
            if (entry.Verdict != Verdict.Accepted)
            {
                queue.Tell(() => Fail($"The host refused --do {action.Text}: {Why(entry.Verdict)}."));
            }
        }
    }

    /// <summary>
    /// Stops waiting for the verdicts that had not come yet. With a fresh copy the numbers of this peer's events may start again, so a
    /// later verdict on one of these numbers would be about another event.
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
        Verdict.TooLate => "it came too late, when nothing could change any more what was to happen then (the host's --history-s)",
        Verdict.TooEarly => "it is stamped too far in the future",
        Verdict.NoRight =>
            "this peer may not do that: it has no right to, or what it did costs more than the host allows (docs/BUDGETS.md)",
        _ => "it makes no sense in this scene",
    };
}

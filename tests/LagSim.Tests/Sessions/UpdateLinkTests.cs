using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>When the next update of a link is due.</summary>
public sealed class UpdateLinkTests
{
    private static readonly SimTime Start = SimTime.FromSeconds(5);

    [Fact]
    public void Flush_RightAfterAnAnswer_DoesNotWait()
    {
        UpdateLink link = Link();
        Send(link, Start);
        SimTime soon = Start + SimDuration.FromMilliseconds(0.3);

        link.Flush(soon);

        Assert.Equal(soon, link.Due);
    }

    [Fact]
    public void Flush_AllTheTime_IsSixtyASecondInTheMean()
    {
        UpdateLink link = Link();
        int sent = 0;
        SimDuration pace = SimDuration.FromMilliseconds(0.125);
        SimTime end = Start + SimDuration.FromSeconds(1);
        for (SimTime now = Start; now < end; now += pace)
        {
            link.Flush(now);
            if (link.Due <= now)
            {
                Send(link, now);
                sent++;
            }
        }

        Assert.Equal(60 + 2, sent);
    }

    [Fact]
    public void Seal_MoreToBeSentAtOnce_WaitsTheLeastDistance()
    {
        UpdateLink link = Link();
        Entries entries = new() { Last = 2000 };
        for (int n = 0; n < SendWindow.MaxDatagramsAtOnce; n++)
        {
            Assert.True(link.IsDue(Start) || n == 0);
            link.Compose(Start);
            link.Fill(entries, Start);
            link.Complete(entries, Start, SimDuration.FromSeconds(1), isUrgent: true);
        }

        Assert.Equal(Start + SimDuration.FromMilliseconds(1), link.Due);
        link.Flush(Start);
        Assert.Equal(Start, link.Due); // what goes out in one moment counts once, so that one who is pressed has two more
    }

    /// <summary>Into a silence of ten seconds goes less and less; to one who answers as much in the last second as in the first.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Silence_HalvesWhatIsSent_StepByStep(bool isAnswered)
    {
        UpdateLink link = Link();
        UpdateDatagram answer = new() { SessionId = 1, Peer = 1 };
        Entries entries = new();
        int[] bytes = new int[10];
        SimTime end = Start + SimDuration.FromSeconds(10);
        uint answers = 0;
        for (SimTime now = Start; now < end; now += SimDuration.FromMilliseconds(1))
        {
            if ((now - Start).ToSeconds() >= entries.Last / 10.0)
            {
                entries.Last++;
                link.NoteNewEntry(5, now);
            }

            if (!link.IsDue(now))
            {
                continue;
            }

            uint number = link.Compose(now).Number;
            link.Fill(entries, now);
            bytes[(int)(now - Start).ToSeconds()] += link.Complete(entries, now, SimDuration.FromSeconds(1), isUrgent: true).Length;
            bool isEarly = (now - Start).ToSeconds() < 0.2; // by then the round trip is known
            if (isEarly || isAnswered)
            {
                // It says that it is there, and has none of the entries yet.
                (answer.Number, answer.EchoNumber, answer.Sent, answer.EchoReceived) = (++answers, number, now, now);
                link.Note(answer, now, out _);
            }
        }

        Assert.True(isAnswered == bytes[8] > bytes[1] / 2, string.Join(" ", bytes));
    }

    /// <summary>
    /// A queue filled the window, and then nothing is answered: what asks into the silence carries entries, though more is in flight than the window has become, and
    /// more and more seldom, however much was on its way.
    /// </summary>
    [Theory]
    [InlineData(2u)]
    [InlineData(8u)]
    public void Silence_BehindAQueue_ProbesCarryEntriesWhateverTheWindow(uint each)
    {
        UpdateLink link = Link();
        Queue<(SimTime At, uint Number, uint Last)> answers = new();
        Entries entries = new();
        UpdateDatagram answer = new() { SessionId = 1, Peer = 1 };
        SimTime silent = Start + SimDuration.FromSeconds(6);
        SimTime end = silent + SimDuration.FromSeconds(10);
        (int carrying, int empty) = (0, 0);
        int[] bytes = new int[10]; // in each second of the silence
        SimTime lastCarrying = SimTime.MinValue;
        for (SimTime now = Start; now < end; now += SimDuration.FromMilliseconds(1))
        {
            while (now < silent && answers.Count > 0 && answers.Peek().At <= now)
            {
                (_, uint number, uint last) = answers.Dequeue();
                (answer.Number, answer.EchoNumber) = (answer.Number + 1, number);
                (answer.Sent, answer.EchoReceived) = (now, now);
                answer.EchoBits = uint.MaxValue;
                link.Note(answer, now, out _);
                link.Acknowledge(last, now);
            }

            if (now < silent)
            {
                entries.Last += each;
                link.NoteNewEntry((int)each * 4, now);
            }

            if (!link.IsDue(now))
            {
                continue;
            }

            UpdateDatagram update = link.Compose(now);
            link.Fill(entries, now);
            int length = link.Complete(entries, now, SimDuration.FromSeconds(1), isUrgent: true).Length;
            bytes[now >= silent ? (int)(now - silent).ToSeconds() : 0] += now >= silent ? length : 0;
            double since = (now - Start).ToSeconds();
            answers.Enqueue((now + SimDuration.FromMilliseconds(since < 2 ? 50 : 50 + Math.Min(400, (since - 2) * 400)), update.Number, link.Outgoing.Sent));
            if (now > silent + SimDuration.FromSeconds(1)) // what was answered before is known by then
            {
                bool carries = update.Held.Length > 0;
                (carrying, empty) = (carrying + (carries ? 1 : 0), empty + (carries ? 0 : 1));
                lastCarrying = carries ? now : lastCarrying;
            }
        }

        Assert.True(link.Traffic.Queueing > SimDuration.Zero, "no queue showed, so nothing was tested");
        string course = string.Join(" ", bytes);
        Assert.True(bytes.Skip(3).Sum() < 3 * 7 * WireFormat.MaxBytes / 2, course);
        Assert.True(carrying is >= 2 and <= 24, $"{carrying} carry entries: {course}");
        Assert.True(lastCarrying > end - SimDuration.FromSeconds(6), $"the last probe with an entry went at {(lastCarrying - silent).ToSeconds()} s");
        Assert.InRange(empty, 0, 12); // one a second, as an idle link sends
    }

    private static UpdateLink Link() => new(new LinkEnds(1, PeerAddress.Virtual(1)) { Peer = 1 }, 0, SimDuration.FromMilliseconds(30), new UpdateDatagram(), new byte[WireFormat.MaxBytes], Start);

    private static void Send(UpdateLink link, SimTime now)
    {
        link.Compose(now);
        Assert.False(link.Complete(new Entries(), now, SimDuration.FromSeconds(1), isUrgent: false).IsEmpty);
    }

    private sealed class Entries : IEntrySource
    {
        public uint Last { get; set; }

        public UpdateEntry this[uint number] => new(Verdict.Accepted, number);
    }
}

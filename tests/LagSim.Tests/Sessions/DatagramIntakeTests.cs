using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Clients;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Tests.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>What comes is told by its kind, and what is none is counted and goes no further.</summary>
public sealed class DatagramIntakeTests : IDatagramHandler
{
    private readonly SessionCounters counters = new();
    private readonly List<string> taken = [];

    [Fact]
    public void Take_EachKind_GoesWhereItBelongs()
    {
        DatagramIntake intake = new(counters, this, isProtected: false);
        byte[] request = new byte[WireFormat.ConnectRequestBytes];
        new ConnectRequestDatagram(1).Encode(request);
        byte[] other = (byte[])request.Clone();
        other[2]++;
        UpdateLink link = new LinkFactory(SimDuration.FromMilliseconds(30)).To(PeerAddress.Virtual(1), 1, 0, SimTime.Zero);
        link.Compose(SimTime.FromSeconds(1));
        ReadOnlySpan<byte> update = link.Complete(new OwnEvents(0), SimTime.FromSeconds(1), SimDuration.FromSeconds(1), isUrgent: false);
        intake.Take(request, PeerAddress.Virtual(1));
        intake.Take(other, PeerAddress.Virtual(1));
        intake.Take(update, PeerAddress.Virtual(1));
        intake.Take(update.Slice(0, update.Length - 1), PeerAddress.Virtual(1));
        intake.Take([1, 2, 3], PeerAddress.Virtual(1));
        Assert.Equal(["ConnectRequest", "other version", "update 1"], taken);
        Assert.Equal((5L, 3L), (counters.DatagramsReceived, counters.DatagramsMalformed));
    }

    /// <summary>In a protected session what belongs to a link counts only sealed, of whatever type it is.</summary>
    [Fact]
    public void Take_UnsealedInAProtectedSession_IsForgedIfItBelongsToALink()
    {
        DatagramType[] free = [
            DatagramType.ConnectRequest, DatagramType.Welcome, DatagramType.Refusal, DatagramType.Challenge, DatagramType.Join, DatagramType.SecureJoin,
            DatagramType.SecureWelcome, DatagramType.SecureRefusal, DatagramType.Reset];
        foreach (DatagramType type in Enum.GetValues<DatagramType>().Where(type => type is not (DatagramType.None or DatagramType.Sealed)))
        {
            foreach (bool isProtected in new[] { false, true })
            {
                SessionCounters counted = new();
                taken.Clear();
                byte[] bytes = type == DatagramType.Update ? AnyDatagram.Bytes(new UpdateDatagram().Encode) : new byte[100];
                WireWriter writer = new(bytes);
                writer.WriteHeader(type);
                new DatagramIntake(counted, this, isProtected).Take(bytes, PeerAddress.Virtual(1));
                Assert.Equal(isProtected && !free.Contains(type) ? (0, 1L) : (1, 0L), (taken.Count, counted.DatagramsForged));
            }
        }
    }

    void IDatagramHandler.OnUpdate(UpdateDatagram update, PeerAddress from) => taken.Add($"update {update.Number}");

    LinkSeal? IDatagramHandler.SealOf(ulong sessionId) => null;

    void IDatagramHandler.OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from, bool isSealed) => taken.Add(type.ToString());

    void IDatagramHandler.OnStrayDatagram(ulong sessionId, PeerAddress from) => taken.Add("stray");

    void IDatagramHandler.OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from) => taken.Add("other version");
}

using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Decides on joins: lets a client in with a link and a snapshot to download, or refuses it with the reason.</summary>
internal sealed class Admission(
    ulong sessionId, HostOptions options, JoinCookies cookies, JoinIdentification identification, JoinRules rules, ClientRoster roster,
    WaitingRoom room, JoinSnapshots snapshots, ClientTimeouts timeouts, LinkFactory links, SessionCounters counters, WrongKeys wrongKeys)
{
    private ulong joins;

    /// <summary>Whether there is a key to guess.</summary>
    private bool HasKeys => options.ConnectKey.Length > 0 || options.PlayerKeys.Count > 0;

    /// <summary>Admits a client that has proved its address.</summary>
    /// <param name="join">What it claims.</param>
    /// <param name="token">Its connect token; empty for none.</param>
    /// <param name="from">Its address.</param>
    /// <param name="reply">Makes the answer, and refuses it.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <returns>The client; null if it may not join and was refused, or if it has to ask again.</returns>
    internal Client? Admit(in JoinDatagram join, ReadOnlySpan<byte> token, PeerAddress from, JoinReply reply, SimTime now)
    {
        JoinIdentity who = identification.Of(join, token, reply.Binding);
        bool isNoGuesser = who.Key is not null && (who.Claimed is not null || who.IsByToken);
        if (!isNoGuesser && HasKeys && MayBeGuessing(from, reply, now))
        {
            counters.DatagramsIgnored++;
            return null;
        }

        if (rules.WhyNot(join, who, from, now) is RefusalReason reason)
        {
            if (reason == RefusalReason.WrongKey && HasKeys && !JoinCookies.IsProof("", join, reply.Binding)) // who has no key guesses none
            {
                wrongKeys.Add(from, join.Proof, now);
            }

            counters.DatagramsIgnored++;
            reply.Refuse(reason, reason == who.Fault ? who.SecondsOff : 0);
            return null;
        }

        JoinSnapshot? made;
        try
        {
            made = snapshots.For(now);
        }
        catch (SceneException)
        {
            reply.Refuse(RefusalReason.TooLarge);
            return null;
        }

        if (made is null)
        {
            return null; // the world is being re-simulated; the client asks again
        }

        if (!options.IsProtected)
        {
            // The same address, proved by the cookie, under a new nonce: the client restarted. One that is in stays until the new one gets
            // its number: if it had only fallen silent, it may be heard again first, and goes on. A protected link has keys to tell it by.
            roster.DropAll(j => j.Peer == 0 && j.Link.Other == from);
        }

        room.MakeRoom(from, made);
        ulong session = cookies.SessionId(sessionId, joins++);
        WelcomeDatagram terms = new(join.Nonce, session, options.Window.History, options.LongestHistory, made.Bytes.Length, made.Hash, made.LogIndex);
        byte[] welcome = reply.Welcome(terms, who.Key!, out LinkSeal? seal);
        UpdateLink link = links.To(from, session, made.LogIndex, now, seal);
        Client admitted = new(new JoinClaim(join, who, token, reply.Handshake, now + timeouts.TimeoutWithCopy(made)), link, made, welcome);
        roster.All.Add(admitted);
        return admitted;
    }

    /// <summary>
    /// Whether a key is not to be looked at, since too many were wrong. One machine's are refused, right or wrong; those of all are not
    /// answered, so that who is no guesser asks again and gets in.
    /// </summary>
    private bool MayBeGuessing(PeerAddress from, JoinReply reply, SimTime now)
    {
        if (wrongKeys.Wait(from.Machine, now) is { Ticks: > 0 } wait)
        {
            reply.Refuse(RefusalReason.TooManyWrongKeys, (uint)Math.Ceiling(wait.ToSeconds()));
            return true;
        }

        return wrongKeys.AreTooMany(now);
    }
}

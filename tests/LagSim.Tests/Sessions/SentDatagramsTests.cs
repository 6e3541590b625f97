using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>What was sent, came and is lost, against a plain list of all of it.</summary>
public sealed class SentDatagramsTests
{
    [Fact]
    public void AnyOrder_IsAsAListOfAllOfThem()
    {
        for (int seed = 0; seed < 20; seed++)
        {
            Random random = new(seed);
            SentDatagrams sent = new();
            List<Sent> model = [];
            SimTime now = SimTime.FromSeconds(1);
            uint newest = 0, came = 0, entry = 0;
            int burst = seed % 10 == 0 ? 100 : 4; // some send more than is remembered before anything comes
            for (int step = 0; step < 400; step++)
            {
                now += SimDuration.FromMilliseconds(random.Next(20));
                string where = $"seed {seed}, step {step}";
                switch (random.Next(8))
                {
                    case 0 or 1:
                        for (int n = random.Next(1, burst + 1); n > 0; n--)
                        {
                            uint first = (uint)Math.Max(1, (long)entry - random.Next(4)), last = first + (uint)random.Next(0, 5) - 1;
                            entry = Math.Max(entry, last);
                            Sent? old = model.Find(s => s.Number + SentDatagrams.Span == newest + 1);
                            uint? forgotten = old is { IsWaitedFor: true } ? old.Number : null;
                            Assert.Equal(forgotten, sent.Add(++newest, now, 100, first, last)?.Number);
                            model.RemoveAll(s => s == old);
                            model.Add(new Sent(newest, now, first, last) { IsWaitedFor = last >= first });
                        }

                        break;
                    case 2 or 3:
                        uint before = (uint)random.Next(random.Next(2) == 0 ? 10 : 1200);
                        uint number = random.Next(50) == 0 ? newest + 5 : newest - Math.Min(newest, before);
                        Sent? known = model.Find(s => s.Number == number);
                        came = known is null ? came : Math.Max(came, number);
                        Sent? waited = known is { IsWaitedFor: true } ? known : null;
                        Same(where, waited, sent.TryAcknowledge(number, out SentDatagrams.Datagram acknowledged), acknowledged);
                        Assert.Equal(known is not null, sent.TryGetTime(number, out SimTime at));
                        Assert.True(known is null || known.At == at, where);
                        break;
                    case 4:
                        uint upTo = (uint)Math.Max(0, (long)entry - random.Next(20));
                        Same(where, Oldest(s => s.Last <= upTo), sent.TryTakeCovered(upTo, out SentDatagrams.Datagram covered), covered);
                        break;
                    case 5 or 6:
                        SimDuration trip = SimDuration.FromMilliseconds(random.Next(1, 80));
                        Sent? lost = Oldest(s => s.Number < came && (came - s.Number >= 3 || now - s.At >= trip + (trip / 8)));
                        Same(where, lost, sent.TryTakeLost(now, trip, out SentDatagrams.Datagram gone), gone);
                        Lose(lost, gone);
                        break;
                    default:
                        Sent? oldest = random.Next(4) == 0 ? Oldest(_ => true) : null;
                        if (oldest is not null)
                        {
                            Same(where, oldest, sent.TryTakeOldest(out SentDatagrams.Datagram taken), taken);
                            Lose(oldest, taken);
                        }

                        break;
                }

                Sent? first1 = model.Find(s => s.IsWaitedFor);
                Assert.Equal(model.Count(s => s.IsWaitedFor), sent.Waited);
                Assert.Equal((first1 is not null, first1?.At ?? default), (sent.TryPeekOldest(out SimTime since), since));
                Assert.Equal(first1 is not null && first1.Number < came, sent.TryGetOvertaken(out _));
            }

            Sent? Oldest(Predicate<Sent> isSo) => model.Find(s => s.IsWaitedFor && isSo(s));

            void Lose(Sent? one, in SentDatagrams.Datagram its)
            {
                if (one is null)
                {
                    return;
                }

                sent.NoteLost(its);
                one.IsLost = true;
                bool isCarried = model.Exists(s => s.Number > one.Number && !s.IsLost && s.First <= one.First && s.Last >= one.Last);
                Assert.Equal(isCarried, sent.IsCarriedLater(its, its.First, its.Last));
            }
        }
    }

    private static void Same(string where, Sent? expected, bool isSo, in SentDatagrams.Datagram actual)
    {
        Assert.True(expected is not null == isSo, where);
        if (expected is not null)
        {
            Assert.Equal((expected.Number, expected.First, expected.Last), (actual.Number, actual.First, actual.Last));
            expected.IsWaitedFor = false;
        }
    }

    private sealed record Sent(uint Number, SimTime At, uint First, uint Last)
    {
        internal bool IsWaitedFor { get; set; }

        internal bool IsLost { get; set; }
    }
}

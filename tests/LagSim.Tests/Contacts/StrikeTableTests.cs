using System;
using System.Collections.Generic;
using LagSim.Collisions;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Contacts;

/// <summary>What is known of the contacts of an instant is found again, for however many of them, and forgotten at the next instant.</summary>
public sealed class StrikeTableTests
{
    [Theory]
    [InlineData(20)]
    [InlineData(5000)]
    public void Find_OfDrawnContacts_HasWhatWasNoted(int contacts)
    {
        Random random = new(contacts);
        StrikeTable table = new();
        Dictionary<(int First, int Second), long> noted = [];
        int instant = 0;
        for (int n = 0; n < 20_000; n++)
        {
            if (random.Next(contacts) == 0)
            {
                instant++;
                noted.Clear();
            }

            (int, int) contact = (random.Next(100), random.Next(4) == 0 ? ~random.Next(10) : random.Next(contacts / 10));
            ref StrikeTable.Entry entry = ref table.Find(contact.Item1, contact.Item2, At(instant));
            Assert.Equal(noted.GetValueOrDefault(contact), entry.First); // 0, the control, where nothing is known
            entry.Note(n + 1, n, n % 3);
            noted[contact] = n + 1;
        }
    }
}

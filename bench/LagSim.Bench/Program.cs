using System;
using System.Collections.Generic;
using System.Linq;
using BenchmarkDotNet.Running;

namespace LagSim.Bench;

internal static class Program
{
    private static readonly Dictionary<string, Action<bool>> Tables = new()
    {
        ["traffic"] = _ => TrafficTable.Print(),
        ["heal"] = HealTable.Print,
        ["dense"] = DenseTable.Print,
        ["bunch"] = BunchTable.Print,
        ["memory"] = MemoryTable.Print,
        ["frames"] = FrameTable.Print,
        ["arrival"] = ArrivalTable.Print,
    };

    /// <summary>Benchmarks, or with the name of a table that table; <c>brief</c> after it for a run of seconds whose figures say little; <c>tables</c> for all but traffic.</summary>
    internal static void Main(string[] arguments)
    {
        if (arguments.Length is 1 or 2 && (arguments.Length == 1 || arguments[1] == "brief"))
        {
            Action<bool>[] named = Tables.Where(t => t.Key == arguments[0] || (arguments[0] == "tables" && t.Key != "traffic")).Select(t => t.Value).ToArray();
            if (named.Length > 0)
            {
                Array.ForEach(named, print => print(arguments.Length == 2));
                return;
            }
        }

        BenchmarkSwitcher.FromAssembly(typeof(Program).Assembly).Run(arguments);
    }
}

using BenchmarkDotNet.Running;

namespace LagSim.Bench;

internal static class Program
{
    internal static void Main(string[] arguments)
    {
        if (arguments is ["traffic"])
        {
            TrafficTable.Print();
        }
        else
        {
            BenchmarkSwitcher.FromAssembly(typeof(Program).Assembly).Run(arguments);
        }
    }
}
